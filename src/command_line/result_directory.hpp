// The directory of a calculator: new, or one of an earlier call, so that no one's files are lost.
#pragma once

#include <filesystem>
#include <string>

namespace geodrop {

/// What a calculator is called and the file that every call of it writes.
struct ResultDirectory {
  std::filesystem::path path;
  std::string command;  ///< "geodrop geotube"
  std::string file;     ///< "geotube.csv"
};

/// Throws SceneError unless the directory is new, empty, or holds that file.
void check_result_directory(const ResultDirectory& directory);

/// Throws RunError if it cannot be made.
void make_result_directory(const std::filesystem::path& path);

}  // namespace geodrop
