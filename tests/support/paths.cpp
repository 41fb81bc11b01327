#include "support/paths.hpp"

namespace geodrop::test {

// Before the globals of test files, some of which are made of these.
[[gnu::init_priority(101)]] const std::string source_directory = GEODROP_SOURCE_DIR;
[[gnu::init_priority(101)]] const std::string program_path = GEODROP_PROGRAM;

}  // namespace geodrop::test
