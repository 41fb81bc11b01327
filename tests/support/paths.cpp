#include "support/paths.hpp"

namespace geodrop::test {

const std::string source_directory = GEODROP_SOURCE_DIR;
const std::string program_path = GEODROP_PROGRAM;

}  // namespace geodrop::test
