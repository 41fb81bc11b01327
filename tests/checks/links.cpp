// The pages lead somewhere: links within the tree, their headings, and the files that pages name.
#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>

#include "support/scene_files.hpp"

using namespace geodrop;

namespace {

namespace fs = std::filesystem;

const fs::path tree = source_path("");

std::vector<fs::path> pages() {
  std::vector<fs::path> found;
  const auto take = [&](const fs::directory_entry& entry) {
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  };
  for (const auto& entry : fs::directory_iterator(tree)) take(entry);
  for (const char* directory : {"cases", "docs", "paraview", "perf", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(tree / directory)) take(entry);
  return found;
}

/// The lines of a page that are no example: blocks of code are indented by four and more.
std::vector<std::string> prose(const fs::path& page) {
  std::istringstream text(read_file(page.string()));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);)
    if (!line.starts_with("    ")) lines.push_back(line);
  return lines;
}

/// What a heading is called in a link: small letters, no marks but '-' and '_', '-' for each space.
std::string anchor(const std::string& heading) {
  std::string name;
  for (const unsigned char letter : heading.substr(heading.find(' ') + 1)) {
    if (letter == ' ') name += '-';
    if (letter >= 0x80 || std::isalnum(letter) || letter == '-' || letter == '_')
      name += static_cast<char>(std::tolower(letter));
  }
  return name;
}

std::set<std::string> anchors(const fs::path& page) {
  std::set<std::string> names;
  for (const std::string& line : prose(page))
    if (line.starts_with("#")) names.insert(anchor(line));
  return names;
}

/// The first group of each match in a line.
std::vector<std::string> found_in(const std::string& line, const std::regex& what) {
  std::vector<std::string> all;
  for (std::sregex_iterator match(line.begin(), line.end(), what), end; match != end; ++match)
    all.push_back((*match)[1]);
  return all;
}

}  // namespace

TEST_CASE("Each local link of a page leads to a file, and to a heading in it") {
  const std::regex link(R"(\]\(([^)\s]+)\))");
  int links = 0;
  for (const fs::path& page : pages())
    for (const std::string& line : prose(page))
      for (const std::string& target : found_in(line, link)) {
        if (target.find("://") != std::string::npos) continue;
        CAPTURE(page.string());
        CAPTURE(target);
        const std::string file = target.substr(0, target.find('#'));
        const fs::path to = file.empty() ? page : page.parent_path() / file;
        CHECK(fs::exists(to));
        if (const auto mark = target.find('#'); mark != std::string::npos)
          CHECK(anchors(to).contains(target.substr(mark + 1)));
        ++links;
      }
  CHECK(links > 50);
}

TEST_CASE("Each file of the tree that a page names is there") {
  const std::regex name(R"(`((?:src|include|tests|cases|docs|perf|paraview|cmake)/[A-Za-z0-9_./-]*)`)");
  for (const fs::path& page : pages())
    for (const std::string& line : prose(page))
      for (const std::string& file : found_in(line, name)) {
        if (file.find("NAME") != std::string::npos) continue;
        CAPTURE(page.string());
        CAPTURE(file);
        CHECK(fs::exists(tree / file));
      }
}

TEST_CASE("Each page says at its end where to go on") {
  for (const auto& entry : fs::recursive_directory_iterator(tree / "docs")) {
    if (entry.path().extension() != ".md" || entry.path().filename() == "scene.md") continue;  // made of the keys
    CAPTURE(entry.path().string());
    const std::string text = read_file(entry.path().string());
    const std::size_t at = text.rfind("Where to go on: ");
    REQUIRE(at != std::string::npos);
    CHECK(text.size() - at < 600);
  }
}
