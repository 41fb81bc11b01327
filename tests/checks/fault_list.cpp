// The list of faults that tests/mutate makes fits the tree: nothing in it has gone stale unseen.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "keys/toml.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;

namespace {

struct Fault {
  std::string name, file, old_text, new_text;
  std::vector<std::string> tests;
};

std::vector<std::string> words_of(const toml::table& table, const char* key) {
  std::vector<std::string> words;
  if (const toml::array* list = table[key].as_array())
    for (const toml::node& word : *list) words.push_back(word.value_or(std::string()));
  return words;
}

std::vector<Fault> listed_faults() {
  const toml::table list = toml::parse(read_file(source_path("tests/mutate/faults.toml")));
  std::vector<Fault> faults;
  for (const toml::node& node : *list["fault"].as_array()) {
    const toml::table& table = *node.as_table();
    const auto text = [&](const char* key) { return table[key].value_or(std::string()); };
    faults.push_back({text("name"), text("file"), text("old"), text("new"), words_of(table, "tests")});
    for (const std::string& scene : words_of(table, "scenes")) faults.back().tests.push_back(scene);
  }
  return faults;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t number = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++number;
  return number;
}

}  // namespace

TEST_CASE("Each fault has a name of its own, changes something and names tests that exist") {
  std::set<std::string> names;
  for (const Fault& fault : listed_faults()) {
    CAPTURE(fault.name);
    CHECK_FALSE(fault.name.empty());
    CHECK(names.insert(fault.name).second);
    CHECK(fault.name.find('|') == std::string::npos);  // names stand in a table
    CHECK_FALSE(fault.old_text.empty());
    CHECK(fault.new_text != fault.old_text);
    CHECK_FALSE(fault.tests.empty());
    for (const std::string& test : fault.tests) {
      const std::string path = source_path("tests/" + test);
      CHECK_MESSAGE((std::filesystem::is_directory(path) || std::filesystem::exists(path + ".cpp")), test);
    }
  }
  CHECK(names.size() >= 100);
}

TEST_CASE("The pattern of each fault occurs exactly once in its file, in one line of it") {
  for (const Fault& fault : listed_faults()) {
    CAPTURE(fault.name);
    CAPTURE(fault.old_text);
    CHECK(fault.file.starts_with("src/"));
    CHECK(count(read_file(source_path(fault.file)), fault.old_text) == 1);
    CHECK(fault.old_text.find('\n') == std::string::npos);
  }
}

TEST_CASE("Every room of the program has a fault") {
  std::set<std::string> rooms;
  for (const auto& entry : std::filesystem::directory_iterator(source_path("src")))
    if (entry.is_directory()) rooms.insert(entry.path().filename().string());
  for (const Fault& fault : listed_faults()) rooms.erase(fault.file.substr(4, fault.file.find('/', 4) - 4));
  for (const std::string& room : rooms) CHECK_MESSAGE(false, room);
}
