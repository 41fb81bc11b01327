// Where the program runs, and where the files of its source tree are.
#pragma once

#include <filesystem>
#include <string>

namespace geodrop {

/// Model of the processor, without commas.
std::string processor_name();

/// Memory that is free for use now [byte].
double available_memory();

/// A file or directory of the source tree, found from the program (`build/PRESET/geodrop`) or from the current
/// directory upwards, or where it is installed (share/geodrop); empty if there is none.
std::filesystem::path find_in_tree(const std::filesystem::path& relative);

/// The same from the program alone: what comes with it.
std::filesystem::path find_beside_program(const std::filesystem::path& relative);

}  // namespace geodrop
