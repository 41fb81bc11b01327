// Where the source tree and the program under test are. Compiled once, so that test files do not hang on the place.
#pragma once

#include <string>

namespace geodrop::test {

extern const std::string source_directory, program_path;

}  // namespace geodrop::test
