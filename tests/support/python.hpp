// Asks Debian's Python, with paraview/ among its modules.
#pragma once

#include <cstdlib>
#include <fstream>
#include <string>

#include "support/scene_files.hpp"

namespace geodrop::test {

inline const std::string python = "/usr/bin/python3";

inline bool python_has(const std::string& modules) {
  return std::system((python + " -c 'import " + modules + "' 2>/dev/null").c_str()) == 0;
}

/// What the code prints; "failed" and what Python says of it if it ends otherwise.
inline std::string ask_python(const std::string& code) {
  const TemporaryDirectory directory;
  const std::string said = directory / "said";
  std::ofstream(directory / "ask.py") << "import sys\nsys.dont_write_bytecode = True\nsys.path.insert(0, '"
                                      << source_path("paraview") << "')\n"
                                      << code;
  const std::string command = python + " '" + (directory / "ask.py").string() + "' >'" + said + "' 2>&1";
  const bool done = std::system(command.c_str()) == 0;
  return (done ? "" : "failed: ") + read_file(said);
}

}  // namespace geodrop::test
