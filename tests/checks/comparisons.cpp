// The sources of the tests: no comparison whose tolerance is not what is written.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/scene_files.hpp"

using namespace geodrop;

namespace {

/// doctest's class, in two parts, so that this file does not hold the name.
const std::string forbidden = std::string("App") + "rox";

/// "tests/FILE:LINE" of each line that holds a word.
std::vector<std::string> lines_with(const std::string& word, const std::filesystem::path& path) {
  std::vector<std::string> found;
  std::istringstream text(read_file(path));
  std::string line;
  for (int number = 1; std::getline(text, line); ++number)
    if (line.find(word) != std::string::npos)
      found.push_back(std::filesystem::relative(path, source_path("")).string() + ":" + std::to_string(number));
  return found;
}

/// The sources of the tests, without support: near.hpp says what it replaces.
std::vector<std::filesystem::path> test_sources() {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_path("tests"))) {
    const std::filesystem::path& path = entry.path();
    if (path.parent_path().filename() == "support") continue;
    if (path.extension() == ".cpp" || path.extension() == ".hpp") found.push_back(path);
  }
  return found;
}

}  // namespace

TEST_CASE("No test compares by doctest's own class, which adds 1 to the scale: near, within or near_zero") {
  const std::vector<std::filesystem::path> sources = test_sources();
  CHECK(sources.size() > 100);  // the folder is read
  for (const std::filesystem::path& path : sources)
    for (const std::string& line : lines_with(forbidden, path)) FAIL_CHECK(line);
}
