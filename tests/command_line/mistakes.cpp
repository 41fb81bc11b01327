// The page of typical mistakes: each of its commands gives the answer beside it, and no mark is below 4.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <regex>
#include <sstream>

#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;

namespace {

/// What the letters of the page stand for.
struct Places {
  std::string run, no_directory;
};

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
    text.replace(at, old.size(), by);
  return text;
}

/// What a command of the page says on both outputs, run in the source tree.
std::string said(const std::string& command, const Places& places) {
  std::string words = command.substr(std::string("geodrop").size()) + " ";
  words = replaced(words, " S ", " cases/dump_kekerdom.toml ");
  words = replaced(words, " R ", " '" + places.run + "' ");
  words = replaced(words, " T ", " '" + places.no_directory + "' ");
  const std::string line = "cd '" + source_directory + "' && '" + program_path + "'" + words + " 2>&1";
  std::string text;
  std::FILE* const pipe = popen(line.c_str(), "r");
  std::array<char, 4096> block;
  for (std::size_t count = 1; pipe && count > 0;) {
    count = std::fread(block.data(), 1, block.size(), pipe);
    text.append(block.data(), count);
  }
  if (pipe) pclose(pipe);
  return text;
}

/// Whether a message says what to write, as a mark of 5 asks.
bool shows_the_way(const std::string& message) {
  constexpr std::array ways = {"allowed: ", "did you mean", "nearest", "it would be", "asked for", "--help",
                               "have ",     "has ",         "run, ",   "e.g. ",       "drawn",     "geodrop "};
  return std::ranges::any_of(ways, [&](const char* way) { return contains(message, way); });
}

}  // namespace

TEST_CASE("Each mistake of the page gets the answer beside it") {
  const geodrop::TemporaryDirectory directory;
  const SceneRun run("cases/elastic_bar.toml", {"time.end=1.0"});
  REQUIRE(run.outcome().code == 0);
  std::istringstream page(geodrop::read_file(geodrop::source_path("docs/mistakes.md")));
  const std::regex row(R"(^\| `(geodrop[^`]*)` \| (.*) \| ([45]) \|$)");
  std::smatch found;
  int rows = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| `geodrop")) continue;
    ++rows;
    CAPTURE(line);
    REQUIRE(std::regex_match(line, found, row));
    const Places places{run.file("").string(), directory / std::to_string(rows)};
    const std::string answer = said(found[1], places), text = found[2];
    const std::size_t at = answer.find(text);
    CHECK_MESSAGE(at != std::string::npos, "it says: " << answer);
    if (at == std::string::npos || found[3] == "4") continue;
    CHECK(shows_the_way(answer.substr(at, answer.find('\n', at) - at)));
  }
  CHECK(rows >= 100);
}
