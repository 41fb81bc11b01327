// The page of typical mistakes: each of its commands gives the answer beside it.
#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <regex>
#include <sstream>

#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;

namespace {

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
    text.replace(at, old.size(), by);
  return text;
}

/// What a command of the page says on both outputs, run in the source tree.
std::string said(const std::string& command) {
  const std::string words =
      replaced(command.substr(std::string("geodrop").size()) + " ", " S ", " cases/dump_kekerdom.toml ");
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

}  // namespace

TEST_CASE("Each mistake of the page gets the answer beside it") {
  std::istringstream page(geodrop::read_file(geodrop::source_path("docs/mistakes.md")));
  const std::regex row(R"(^\| `(geodrop[^`]*)` \| (.*) \|$)");
  std::smatch found;
  int rows = 0;
  for (std::string line; std::getline(page, line);) {
    if (!std::regex_match(line, found, row)) continue;
    ++rows;
    const std::string answer = said(found[1]);
    CHECK_MESSAGE(contains(answer, found[2]), found[1].str()
                                                  << "\n  should say: " << found[2].str() << "\n  says: " << answer);
  }
  CHECK(rows >= 60);
}
