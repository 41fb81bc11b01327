// What the command line says beyond its options: examples, and what was probably meant by a mistyped word.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// "Examples:" with a line or two for the help of a command; empty if there are none.
std::string examples_of(const std::string& command);

/// A command as an example of its use; empty if there is none.
std::string first_example(const std::string& command);

/// What is wrong with the words of a command line that CLI did not take: an unknown command or option, with the
/// nearest; empty if it is something else. The program is the first word.
std::string hint_for(const CLI::App& app, const std::vector<std::string>& words);

/// "--output", ... of a command.
std::vector<std::string> option_names(const CLI::App& command);

/// All commands, in one line.
std::string commands_of(const CLI::App& app);

}  // namespace geodrop
