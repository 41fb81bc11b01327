// --threads of commands.
#pragma once

#include <CLI/CLI.hpp>

namespace geodrop {

void add_threads(CLI::App& command, int& threads);
/// Where fewer may be taken.
void add_most_threads(CLI::App& command, int& threads);

/// The flag of `run` that takes none off.
inline constexpr const char* exact_threads = "--exact-threads";

/// Number of threads to use, all cores if 0 are asked for; warns if there are fewer cores.
int choose_threads(int asked);

}  // namespace geodrop
