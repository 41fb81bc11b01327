// docs/theory.md: each section says in which file of the source it stands (that the files are there: links.cpp).
#include <doctest/doctest.h>

#include <regex>

#include "support/scene_files.hpp"

using namespace geodrop;

TEST_CASE("Each section of the theory names the file where its equations stand") {
  std::istringstream page(read_file(source_path("docs/theory.md")));
  const std::regex file(R"(`(src|include)/[A-Za-z0-9_./]+\.(cpp|hpp)`)");
  std::string section;
  int named = 0, sections = 0;
  const auto close = [&] {
    CAPTURE(section);
    if (!section.empty()) CHECK(named > 0);
    named = 0;
  };
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) {
      close();
      section = line.substr(3);
      ++sections;
    }
    if (std::regex_search(line, file)) ++named;
  }
  close();
  CHECK(sections >= 10);
}

TEST_CASE("codemeta.json says of the program what the other files say") {
  const std::string meta = read_file(source_path("codemeta.json"));
  const std::string citation = read_file(source_path("CITATION.cff")), build = read_file(source_path("CMakeLists.txt"));
  std::smatch version;
  REQUIRE(std::regex_search(build, version, std::regex(R"(project\(geodrop VERSION ([0-9.]+))")));
  CHECK(meta.find("\"version\": \"" + version[1].str() + "\"") != std::string::npos);
  CHECK(citation.find("version: " + version[1].str()) != std::string::npos);
  CHECK(meta.find("\"license\": \"https://spdx.org/licenses/MIT\"") != std::string::npos);
  std::smatch date;
  REQUIRE(std::regex_search(citation, date, std::regex("date-released: ([0-9-]+)")));
  CHECK(meta.find("\"dateModified\": \"" + date[1].str() + "\"") != std::string::npos);
  for (const char* of_paper : {"Dropping Geocontainers in Water", "Fursan", "Hamad", "Christian", "Moormann"}) {
    CAPTURE(of_paper);
    CHECK(meta.find(of_paper) != std::string::npos);
    CHECK(citation.find(of_paper) != std::string::npos);
  }
}
