// What the bits of a run may depend on beside its scene: program, compiler, the way sums round on the processor.
#pragma once

#include <string>

namespace geodrop {

struct BuildIdentity {
  std::string version;   ///< of the program, with its commit
  std::string compiler;  ///< and how it was used
  std::string sums;      ///< "fused" or "plain", see base/levels.hpp
  bool operator==(const BuildIdentity&) const = default;
};

/// Of this program on this machine.
BuildIdentity this_build();

/// In which ways the builds differ, e.g. "geodrop 0.1.0 instead of 0.2.0, sums plain instead of fused";
/// empty: in none.
std::string differences(const BuildIdentity& before, const BuildIdentity& now);

}  // namespace geodrop
