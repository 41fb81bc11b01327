// What the bits of a run depend on beside its scene: program, compiler, processor.
#pragma once

#include <string>

namespace geodrop {

struct BuildIdentity {
  std::string version;    ///< of the program, with its commit
  std::string compiler;   ///< and how it was used
  std::string processor;  ///< level that the kernels were chosen for, see kernels/chunk.hpp
  bool operator==(const BuildIdentity&) const = default;
};

/// Of this program on this machine.
BuildIdentity this_build();

/// In which ways the builds differ, e.g. "geodrop 0.1.0 instead of 0.2.0, kernels for x86-64-v3 instead of x86-64-v4";
/// empty: in none.
std::string differences(const BuildIdentity& before, const BuildIdentity& now);

}  // namespace geodrop
