// --threads of commands.
#pragma once

#include <CLI/CLI.hpp>

namespace geodrop {

void add_threads(CLI::App& command, int& threads);

/// Number of threads to use, all cores if 0 are asked for; warns if there are fewer cores.
int choose_threads(int asked);

}  // namespace geodrop
