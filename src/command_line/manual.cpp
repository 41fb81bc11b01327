#include "manual.hpp"

#include <vector>

#include "hints.hpp"

namespace geodrop {
namespace {

std::vector<const CLI::App*> commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string long_options(const CLI::App& command) {
  std::string words;
  for (const std::string& name : option_names(command)) words += (words.empty() ? "" : " ") + name;
  return words;
}

/// With what roff would take for its own replaced.
std::string roff(const std::string& plain) {
  std::string text;
  for (const char letter : plain) {
    if (letter == '\\')
      text += "\\e";
    else if (letter == '-')
      text += "\\-";
    else
      text += letter;
    if (letter == '\n') text += "\\&";  // no line begins with a dot or a quote of its own
  }
  return text;
}

/// Its arguments and options, but --help.
std::string options_text(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : command.get_options())
    if (!option->check_lname("help"))
      text += ".TP\n.B " + roff(option->get_name()) + "\n" + roff(option->get_description()) + "\n";
  return text;
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::string names, cases;
  for (const CLI::App* command : commands(app)) {
    names += command->get_name() + " ";
    cases += "    " + command->get_name() + ") options=\"" + long_options(*command) + "\" ;;\n";
  }
  return "# Completion of geodrop for bash, written by `geodrop manual --completion`.\n"
         "_geodrop() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} options=\"\"\n"
         "  if ((COMP_CWORD == 1)); then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"" +
         names + "help " + long_options(app) +
         "\" -- \"$word\")\n"
         "    return\n"
         "  fi\n"
         "  case ${COMP_WORDS[1]} in\n" +
         cases +
         "  esac\n"
         "  if [[ $word == -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\")\n"
         "  else\n"
         "    mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _geodrop geodrop ./geodrop\n";
}

std::string manual_page(const CLI::App& app, const std::string& version) {
  std::string page =
      ".TH GEODROP 1 \"\" \"geodrop " + version +
      "\" \"User Commands\"\n.SH NAME\ngeodrop \\- Material Point Method for soil, water and geotextile\n"
      ".SH SYNOPSIS\n.B geodrop\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.br\n.B geodrop help\n"
      "[\\fICOMMAND\\fR]\n.SH OPTIONS\n" +
      options_text(app) + ".TP\n.B \\-\\-help\nwhat there is; after a command, its options\n.SH COMMANDS\n";
  for (const CLI::App* command : commands(app)) {
    page += ".SS geodrop " + roff(command->get_name()) + "\n" + roff(command->get_description()) + "\n";
    page += options_text(*command);
    if (const std::string examples = examples_of(command->get_name()); !examples.empty())
      page += ".PP\n.nf\n\\&" + roff(examples) + "\n.fi\n";
  }
  return page +
         ".SH EXIT STATUS\n0 done; 1 numerical failure, an expectation not met, or no program that prints; 2 usage or "
         "scene; 70 internal; 74 "
         "files "
         "that the disk does not take; 75 stopped with a checkpoint; 130 ended by a second Ctrl\\-C.\n"
         ".SH SEE ALSO\nThe pages of the documentation: tutorial, cookbook, scene.\n";
}

}  // namespace geodrop
