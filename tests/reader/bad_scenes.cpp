// Scenes with mistakes, one file each: the lines "# expect:" at its top are parts of the message.
#include "support/scene_files.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>

using namespace geodrop;

namespace {

std::vector<std::filesystem::path> bad_scenes() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(source_path("tests/bad_scenes"))) {
    if (entry.path().extension() == ".toml") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::vector<std::string> expected_parts(const std::filesystem::path& path) {
  const std::string mark = "# expect: ";
  std::vector<std::string> parts;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line) && line.starts_with(mark);) parts.push_back(line.substr(mark.size()));
  return parts;
}

int run_program(const std::string& arguments, const std::filesystem::path& messages) {
  const std::string command =
      "\"" + geodrop::test::program_path + "\" " + arguments + " > \"" + messages.string() + "\" 2>&1";
  return WEXITSTATUS(std::system(command.c_str()));
}

}  // namespace

TEST_CASE("each bad scene gives the expected messages, and no others") {
  const auto paths = bad_scenes();
  CHECK(paths.size() >= 20);
  for (const std::filesystem::path& path : paths) {
    const std::string error = scene_error(path);
    CAPTURE(error);
    const std::vector<std::string> parts = expected_parts(path);
    REQUIRE_FALSE(parts.empty());
    for (const std::string& part : parts) {
      CAPTURE(part);
      CHECK(error.find(part) != std::string::npos);
    }
    for (std::istringstream lines(error); !lines.eof();) {
      std::string line;
      std::getline(lines, line);
      CAPTURE(line);
      CHECK(line.starts_with(path.string() + ':'));
      CHECK(std::any_of(parts.begin(), parts.end(),
                        [&](const std::string& part) { return line.find(part) != std::string::npos; }));
    }
  }
}

TEST_CASE("the program refuses each bad scene with exit code 2 and makes no run directory") {
  for (const std::filesystem::path& path : bad_scenes()) {
    const TemporaryDirectory directory;
    const std::filesystem::path output = directory / "run", messages = directory / "messages";
    CAPTURE(path.string());
    CHECK(run_program("run \"" + path.string() + "\" --output \"" + output.string() + '"', messages) == 2);
    CHECK_FALSE(std::filesystem::exists(output));
    const std::string text = read_file(messages);
    CAPTURE(text);
    CHECK(text.find(scene_error(path)) != std::string::npos);
  }
}

TEST_CASE("a file that is not there, a directory, an empty file, a file that is no text") {
  const TemporaryDirectory directory;
  const auto path = [&](const char* name) { return (directory / name).string(); };
  CHECK(scene_error(path("none.toml")) == path("none.toml") + ": found no such file; allowed: a scene in TOML");
  CHECK(scene_error(directory / "") == path("") + ": found a directory, not a regular file; allowed: a scene in TOML");
  CHECK(scene_error_of_text("").find(":1:1: bodies: found nothing: the key is missing") != std::string::npos);
  CHECK(scene_error_of_text("[;bodies]]").find(":1:2: syntax: found") != std::string::npos);
  CHECK(scene_error_of_text("[[[bodies]]").find("syntax: found") != std::string::npos);
  CHECK(scene_error_of_text("\xff\xfe\x01").find("syntax: found") != std::string::npos);
}

TEST_CASE("all problems are reported at once, in the order of the file") {
  const std::string error = scene_error_of_text("title = 1\n[grid]\nspacing = -1\nlower = 3\n");
  const std::vector<std::string> parts{
      ":1:1: gravity: ", ":1:9: title: ", ":2:1: grid.upper: ", ":3:11: grid.spacing: ", ":4:9: grid.lower: "};
  std::size_t last = 0;
  for (const std::string& part : parts) {
    CAPTURE(part);
    CAPTURE(error);
    const std::size_t at = error.find(part);
    REQUIRE(at != std::string::npos);
    CHECK(at >= last);
    last = at;
  }
}
