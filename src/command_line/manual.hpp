// The options of all commands for a shell that completes them, and as a page of the manual.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace geodrop {

/// For bash: commands, then options of the command, else files.
std::string bash_completion(const CLI::App& app);

/// geodrop(1) in roff.
std::string manual_page(const CLI::App& app, const std::string& version);

}  // namespace geodrop
