// The rooms of the source tree: the table of docs/architecture.md lists each folder of src/ and include/geodrop/ from
// the lowest to the highest, and no file includes one of a higher room.
#include <doctest/doctest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "support/scene_files.hpp"

using namespace geodrop;

namespace {

namespace fs = std::filesystem;

/// Rooms in the order of the page, the lowest first.
std::vector<std::string> rooms_of_page() {
  std::istringstream page(read_file(source_path("docs/architecture.md")));
  const std::regex row("^\\| `([a-z_]+)` \\|.*");
  std::vector<std::string> rooms;
  std::smatch found;
  for (std::string line; std::getline(page, line);)
    if (std::regex_match(line, found, row)) rooms.push_back(found[1]);
  return rooms;
}

/// The room that a path in src/ or include/ begins with; src/main.cpp is of the program.
std::string room_of(const std::string& path) {
  const std::size_t end = path.find('/');
  return end == std::string::npos ? "command_line" : path.substr(0, end);
}

struct Arrow {
  std::string file, from, to;
};

/// Includes of the files below a root, where those in quotes are of `src/` or stand beside the file.
void add_arrows(const fs::path& root, std::vector<Arrow>& arrows) {
  const std::regex include(R"re(^#include (<geodrop/|")([^>"]+)[>"])re");
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    const std::string file = fs::relative(entry.path(), root).string();
    std::istringstream text(read_file(entry.path()));
    std::smatch found;
    for (std::string line; std::getline(text, line);) {
      if (!std::regex_search(line, found, include)) continue;
      const std::string target = found[2];
      if (target.find('/') != std::string::npos) arrows.push_back({file, room_of(file), room_of(target)});
    }
  }
}

std::vector<Arrow> all_arrows() {
  std::vector<Arrow> arrows;
  add_arrows(source_path("src"), arrows);
  add_arrows(source_path("include/geodrop"), arrows);
  return arrows;
}

}  // namespace

TEST_CASE("The page lists the rooms that are there") {
  std::set<std::string> folders;
  for (const char* root : {"src", "include/geodrop"})
    for (const auto& entry : fs::directory_iterator(source_path(root)))
      if (entry.is_directory()) folders.insert(entry.path().filename());
  const std::vector<std::string> rooms = rooms_of_page();
  CHECK(std::set<std::string>(rooms.begin(), rooms.end()) == folders);
  CHECK(rooms.size() == folders.size());
}

TEST_CASE("No file includes one of a higher room") {
  const std::vector<std::string> rooms = rooms_of_page();
  const auto height = [&](const std::string& room) { return std::find(rooms.begin(), rooms.end(), room); };
  const std::vector<Arrow> arrows = all_arrows();
  CHECK(arrows.size() > 500);
  for (const Arrow& arrow : arrows) {
    CAPTURE(arrow.file);
    CAPTURE(arrow.to);
    REQUIRE(height(arrow.to) != rooms.end());
    CHECK(height(arrow.to) <= height(arrow.from));
  }
}
