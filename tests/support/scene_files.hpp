// Scene files for tests: those of the repository, and texts that a test writes.
#pragma once

#include <geodrop/reader/scene_reader.hpp>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "support/paths.hpp"

namespace geodrop {

inline std::string source_path(const std::string& relative) { return test::source_directory + "/" + relative; }

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A directory that goes away with its owner.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "geodrop_test_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryDirectory() { std::filesystem::remove_all(path_); }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// The message of the SceneError that reading gives; empty if it gives none.
inline std::string scene_error(const std::string& path, const std::vector<std::string>& overrides = {}) {
  try {
    read_scene(path, overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

inline std::string scene_error_of_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory / "scene.toml";
  std::ofstream(path) << text;
  return scene_error(path, overrides);
}

}  // namespace geodrop
