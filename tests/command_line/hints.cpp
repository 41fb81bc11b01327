// Mistyped commands and options, help, examples, JSON for other programs, new scenes, the schema.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <regex>

#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;
namespace fs = std::filesystem;

namespace {

std::string refused(const std::vector<std::string>& words) {
  const Outcome outcome = run_program(words);
  CHECK(outcome.code == 2);
  return outcome.err;
}

/// What the pattern's group finds in each line.
std::vector<std::string> first_words(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> words;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (std::smatch match; std::regex_search(line, match, pattern)) words.push_back(match[1]);
  return words;
}

/// What stands after the first text, up to the next one; empty if there is none.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t at = text.find(before);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + before.size();
  return text.substr(begin, text.find(after, begin) - begin);
}

}  // namespace

TEST_CASE("What was meant by a mistyped command or option is told") {
  CHECK(contains(refused({"rn"}), "no command \"rn\"; did you mean run?"));
  CHECK(contains(refused({"snapshoot", "runs/x"}), "did you mean snapshot?"));
  CHECK(contains(refused({"tset"}), "did you mean test?"));
  CHECK(contains(refused({"test"}), "./geodrop in the source tree"));
  const std::string nonsense = refused({"nonsense"});
  CHECK(contains(nonsense, "geodrop --help"));
  CHECK_FALSE(contains(nonsense, "did you mean"));
  CHECK(contains(refused({"run", "a.toml", "--thread", "2"}),
                 "no option --thread of geodrop run; did you mean --threads?"));
  CHECK(contains(refused({"run", "a.toml", "-o", "x"}), "did you mean --output?"));
  CHECK(contains(refused({"run", "a.toml", "--Set", "k=v"}), "did you mean --set?"));
  CHECK(contains(refused({}), "a command is missing: run, check"));
  const std::string missing = refused({"geotube", "--perimeter", "9.2", "--unit-wieght", "12e3", "--area", "5.56"});
  CHECK(contains(missing, "no option --unit-wieght of geodrop geotube; did you mean --unit-weight?"));
  CHECK(contains(missing, "geodrop geotube: --unit-weight is required"));
}

TEST_CASE("help, and examples in the help of every command") {
  const Outcome help = run_program({"help"});
  CHECK(help.code == 0);
  CHECK(help.out == run_program({"--help"}).out);
  const std::string sweep = run_program({"help", "sweep"}).out;
  CHECK(contains(sweep, "Usage: geodrop sweep "));
  CHECK(sweep == run_program({"sweep", "--help"}).out);
  CHECK(run_program({"help", "nonsense"}).code == 2);
  for (const char* command :
       {"run",      "check", "stages", "info",     "bench",   "geotube", "release", "fall", "verify", "replay",
        "ensemble", "sweep", "plot",   "snapshot", "animate", "report",  "compare", "new",  "schema", "manual"}) {
    const Outcome outcome = run_program({command, "--help"});
    CHECK(outcome.code == 0);
    CHECK_MESSAGE(contains(outcome.out, std::string("Examples:\n  geodrop ") + command), command);
  }
}

TEST_CASE("The manual and the completion know every command and option that the help knows") {
  const std::string page = run_program({"manual"}).out, completion = run_program({"manual", "--completion"}).out;
  CHECK(page.starts_with(".TH GEODROP 1"));
  CHECK(contains(page, ".B \\-\\-version\n"));
  const std::string help = run_program({"--help"}).out;
  const std::vector<std::string> commands =
      first_words(help.substr(help.find("Subcommands:")), std::regex("^  ([a-z]+) "));
  REQUIRE(commands.size() >= 20);
  for (const std::string& command : commands) {
    CAPTURE(command);
    const std::string section = between(page, ".SS geodrop " + command + "\n", "\n.S");
    const std::string completed = between(completion, "    " + command + ") options=\"", "\"") + ' ';
    CHECK(contains(between(completion, "compgen -W \"", "\""), command + ' '));
    for (const std::string& option :
         first_words(run_program({command, "--help"}).out, std::regex("^  (?:-h,)?(--[a-z-]+)"))) {
      CAPTURE(option);
      CHECK(contains(completed, option + ' '));
      CHECK((option == "--help" || contains(section, ".B " + std::regex_replace(option, std::regex("-"), "\\-"))));
    }
  }
}

TEST_CASE("The completion of bash") {
  const geodrop::TemporaryDirectory directory;
  std::ofstream(directory / "geodrop") << run_program({"manual", "--completion"}).out;
  const auto completed = [&](const std::string& words, int at) {
    const std::string command = "bash -c 'source " + (directory / "geodrop").string() + "; COMP_WORDS=(" + words +
                                "); COMP_CWORD=" + std::to_string(at) + "; _geodrop; echo ${COMPREPLY[*]}' >" +
                                (directory / "said").string();
    REQUIRE(std::system(command.c_str()) == 0);
    return geodrop::read_file(directory / "said");
  };
  CHECK(completed("geodrop sn", 1) == "snapshot\n");
  CHECK(completed("geodrop --v", 1) == "--version\n");
  CHECK(completed("geodrop run a.toml --ov", 3) == "--overwrite\n");
  CHECK(completed("geodrop sweep --no", 2) == "--no-run\n");
}

TEST_CASE("check and info as JSON") {
  using Json = nlohmann::json;
  const std::string bar = geodrop::source_path("cases/elastic_bar.toml");
  const Json good = Json::parse(run_program({"check", bar, "--json"}).out);
  CHECK(good["problems"].empty());
  CHECK(good["effort"]["particles"].get<double>() > 0);
  CHECK(good["effort"]["steps"].get<double>() > 0);
  CHECK(good["effort"]["wall_s"].get<double>() > 0);
  CHECK(good["effort"]["output_bytes"].get<double>() > 0);
  const Outcome outcome = run_program({"check", bar, "--json", "--set", "grid.spacng=1"});
  CHECK(outcome.code == 2);
  const Json bad = Json::parse(outcome.out);
  REQUIRE(bad["problems"].size() == 1);
  CHECK(bad["problems"][0]["key"] == "grid.spacng");
  CHECK(bad["effort"].is_null());
  const Outcome in_tonnes = run_program({"check", geodrop::source_path("cases/dump_kekerdom.toml"), "--json", "--set",
                                         "grid.spacng=1", "--set", "materials.water.density=1.0"});
  CHECK(contains(in_tonnes.out, "in t/m3 it would be 1000 kg/m3"));
  const Json info = Json::parse(run_program({"info", bar, "--json"}).out);
  CHECK(info["particles_count"].get<double>() > 0);
  CHECK(info["time_step_s"].get<double>() > 0);
  CHECK(info["memory_bytes"] == good["effort"]["memory_bytes"]);
  CHECK(info["memory_bytes"].get<double>() > 25e6);  // of the program alone
  for (const char* name : {"particles", "steps", "memory_bytes", "output_bytes"})
    CHECK_MESSAGE(good["effort"][name].is_number_integer(), name);
  for (const char* name : {"particles_count", "steps_count", "bytes_per_particle_count", "memory_bytes"})
    CHECK_MESSAGE(info[name].is_number_integer(), name);
  CHECK(std::regex_match(good["effort"]["steps"].dump(), std::regex("[1-9][0-9]{0,2}0*")));  // three digits
}

TEST_CASE("A new scene passes check without a doubt, and is not written twice") {
  const geodrop::TemporaryDirectory directory;
  const std::string file = directory / "my_bag.toml";
  CHECK(run_program({"new", directory / "my_bag"}).code == 0);
  const Outcome check = run_program({"check", file});
  CAPTURE(check.err);
  CHECK(check.code == 0);
  CHECK_FALSE(contains(check.out, "warning:"));
  const std::string two_words = directory / "my scene.toml";
  CHECK(contains(run_program({"new", directory / "my scene"}).out, "next: geodrop check '" + two_words + "'\n"));
  CHECK(contains(refused({"new", directory / "my_bag"}), "which is there already"));
  CHECK(run_program({"new", directory / "tube", "--from", "geotube_556"}).code == 0);
  CHECK(geodrop::read_file(directory / "tube.toml") ==
        geodrop::read_file(geodrop::source_path("cases/geotube_556.toml")));
  CHECK(contains(refused({"new", directory / "other", "--from", "geotub_556"}), "the nearest is \"geotube_556\""));
  const std::string listed = run_program({"new", "--list"}).out;
  CHECK(std::regex_search(listed, std::regex("\ngeotube_556 +[A-Z].*\n")));  // with its title
  CHECK(listed.find("\nelastic_bar ") < listed.find("\nbreathing_tube "));   // cases/ before the folders in it
}

TEST_CASE("The schema knows the keys, their words and units") {
  const auto schema = nlohmann::json::parse(run_program({"schema"}).out);
  const auto& keys = schema["properties"];
  CHECK(contains(keys["grid"]["properties"]["spacing"]["description"], "[m]"));
  CHECK(keys["solver"]["properties"]["transfer"]["enum"].size() == 3);
  CHECK(keys["bodies"]["items"]["required"][0] == "name");
  CHECK(keys["materials"]["additionalProperties"]["properties"].contains("density"));
}
