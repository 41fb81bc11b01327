#include "build_identity.hpp"

#include <geodrop/version.hpp>

#include "base/levels.hpp"

namespace geodrop {
namespace {

std::string compiler() {
#ifdef __clang__
  std::string text = "clang++ ";
#else
  std::string text = "g++ ";
#endif
  text += __VERSION__;
#ifdef NDEBUG
  text += ", optimised";
#endif
#ifdef __SANITIZE_ADDRESS__
  text += ", with sanitizers";
#endif
  return text;
}

}  // namespace

BuildIdentity this_build() { return {GEODROP_VERSION, compiler(), kernel_arithmetic()}; }

std::string differences(const BuildIdentity& before, const BuildIdentity& now) {
  std::string text;
  const auto compare = [&](const std::string& what, const std::string& was, const std::string& is) {
    if (was != is) text += (text.empty() ? "" : ", ") + what + was + " instead of " + is;
  };
  compare("geodrop ", before.version, now.version);
  compare("", before.compiler, now.compiler);
  compare("sums ", before.sums, now.sums);
  return text;
}

}  // namespace geodrop
