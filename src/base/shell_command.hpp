// Commands as a user would type them into a shell.
#pragma once

#include <string>
#include <vector>

namespace geodrop {

/// The word itself where a POSIX shell leaves it alone, else in single quotes.
std::string shell_word(const std::string& word);

/// The words as a user would type them.
std::string shell_command(const std::vector<std::string>& words);

/// The command that goes on with a run: every word of the one that began it, first the program, but without --until and
/// --overwrite, and with --resume.
std::string resume_command(const std::vector<std::string>& words);

}  // namespace geodrop
