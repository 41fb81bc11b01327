// The calculators with options and values at random: an answer without nan or inf, or a refusal.
#include "fuzz/fuzz.hpp"

#include "command_line/fall.hpp"
#include "command_line/geotube.hpp"
#include "command_line/release.hpp"

#include <geodrop/base/error.hpp>

#include <algorithm>
#include <iostream>
#include <sstream>

using namespace geodrop;

namespace {

/// What the program prints meanwhile.
class Capture {
 public:
  Capture() : before_(std::cout.rdbuf(text_.rdbuf())) {}
  ~Capture() { std::cout.rdbuf(before_); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::streambuf* before_;
};

using Words = std::vector<std::string>;

/// A calculator: its options, the call that is right, and how it is run.
struct Calculator {
  std::string name;
  Words call;
  int (*run)(CLI::App&, const Words&);
};

void parse(CLI::App& app, const Words& words) {
  app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 wants them backwards
}

int run_tube(CLI::App& app, const Words& words) {
  GeotubeArguments arguments;
  add_geotube_options(app, arguments);
  parse(app, words);
  return run_geotube(arguments);
}
int run_opening(CLI::App& app, const Words& words) {
  ReleaseArguments arguments;
  add_release_options(app, arguments);
  parse(app, words);
  return run_release(arguments);
}
int run_sinking(CLI::App& app, const Words& words) {
  FallArguments arguments;
  add_fall_options(app, arguments);
  parse(app, words);
  return run_fall(arguments);
}

const std::vector<Calculator>& calculators() {
  static const std::vector<Calculator> all{
      {"geotube", {"--perimeter", "9.2", "--unit-weight", "12e3", "--area", "5.56"}, run_tube},
      {"geotube", {"--perimeter", "9.2", "--unit-weight", "12e3", "--table", "height=0.5:2.5:0.1"}, run_tube},
      {"release",
       {"--perimeter", "18.3", "--area", "10.8", "--density", "1990", "--water-density", "1000", "--opening-width",
        "3"},
       run_opening},
      {"fall",
       {"--semi-axes", "3.326767", "0.507698", "--density", "1631", "--water-density", "1000", "--terminal-velocity",
        "3.3", "--fall-height", "9.8"},
       run_sinking}};
  return all;
}

/// The long names of the options of a calculator, but those that write files.
Words options_of(const Calculator& calculator) {
  CLI::App app;
  try {
    const Capture quiet;
    calculator.run(app, {"--help"});
  } catch (const CLI::ParseError&) {
  }
  Words names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames())
      if (name != "output" && name != "help") names.push_back("--" + name);
  return names;
}

/// In place of the value that the option has in the call, if it has one.
void set_option(const std::string& option, const std::string& value, Words& words) {
  const auto found = std::find(words.begin(), words.end(), option);
  if (found != words.end() && found + 1 != words.end())
    *(found + 1) = value;
  else
    words.insert(words.end(), {option, value});
}

Words changed_call(const Calculator& calculator, fuzz::Chance& chance) {
  Words words = calculator.call;
  const Words options = options_of(calculator);
  for (std::size_t i = 0; i <= chance.below(4); ++i) {
    const std::string& number = chance.of(fuzz::odd_numbers());
    switch (chance.below(20)) {
      case 0:
        words.erase(words.begin() + static_cast<std::ptrdiff_t>(chance.below(words.size())));
        if (words.empty()) return words;
        break;
      case 1:
        words.push_back(number);
        break;
      case 2:
        words.push_back("height=" + number + ":" + chance.of(fuzz::odd_numbers()) + ":" +
                        chance.of(fuzz::odd_numbers()));
        break;
      case 3:
      case 4:
      case 5:
      case 6:
      case 7:
      case 8:
        set_option(options[chance.below(options.size())], chance.one_in(3) ? "0.7" : number, words);
        break;
      default: {
        std::string& word = words[chance.below(words.size())];
        if (!word.starts_with("--")) word = chance.one_in(2) ? number : word + (chance.one_in(2) ? "e3" : "e-2");
      }
    }
  }
  return words;
}

/// A number that is none, as a word of its own.
bool shows_no_number(const std::string& text) {
  std::istringstream words(text);
  for (std::string word; words >> word;)
    for (const char* none : {"nan", "inf", "-nan", "-inf"})
      if (word == none) return true;
  return false;
}

std::string attempt(const Calculator& calculator, const Words& words) {
  CLI::App app;
  try {
    const Capture capture;
    const int code = calculator.run(app, words);
    if (code != 0) return "failed: exit code " + std::to_string(code);
    return shows_no_number(capture.text()) ? "failed: a number that is none" : "answered";
  } catch (const CLI::ParseError&) {
    return "refused as an option";
  } catch (const SceneError& error) {
    return std::string(error.what()).find("found ") == std::string::npos ? "failed: no reason" : "refused";
  }
}

std::string joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += word + "\n";
  return text;
}

}  // namespace

TEST_CASE("Calculators answer or refuse whatever they are asked") {
  fuzz::Trials trials("calculators", 10000);
  const Calculator* chosen = nullptr;
  Words words;
  trials.run(
      ".txt",
      [&](fuzz::Chance& chance) {
        chosen = &calculators()[chance.below(calculators().size())];
        words = changed_call(*chosen, chance);
        return chosen->name + "\n" + joined(words);
      },
      [&](const std::filesystem::path&, fuzz::Chance&) { return attempt(*chosen, words); });
}
