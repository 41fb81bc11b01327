#include "result_directory.hpp"

#include <geodrop/base/error.hpp>

namespace geodrop {

namespace fs = std::filesystem;

void check_result_directory(const ResultDirectory& directory) {
  const auto refuse = [&](const std::string& found) {
    throw SceneError(directory.path.string(), {{{},
                                                "--output",
                                                found,
                                                "a new directory or one of an earlier " + directory.command,
                                                ProblemSource::elsewhere}});
  };
  if (!fs::exists(directory.path)) return;
  if (!fs::is_directory(directory.path)) refuse("a file");
  if (!fs::is_empty(directory.path) && !fs::exists(directory.path / directory.file))
    refuse("a directory with other files in it");
}

void make_result_directory(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw RunError("cannot make the directory " + path.string() + ": " + error.message());
}

}  // namespace geodrop
