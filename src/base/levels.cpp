#include "levels.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

namespace geodrop {

#ifdef GEODROP_ONE_LEVEL

KernelLevel kernel_level() { return KernelLevel::x86_64_v3; }
const char* kernel_level_name() { return "one"; }
const char* kernel_arithmetic() { return "fused"; }

#else

namespace {

constexpr std::array<const char*, 3> names = {"x86-64-v2", "x86-64-v3", "x86-64-v4"};

KernelLevel choose_level() {
  std::size_t level = __builtin_cpu_supports("x86-64-v4") ? 2 : __builtin_cpu_supports("x86-64-v3") ? 1 : 0;
  if (const char* const asked = std::getenv("GEODROP_KERNELS"))
    for (std::size_t k = 0; k < names.size(); ++k)
      if (std::string_view(asked) == names[k]) level = std::min(level, k);
  return static_cast<KernelLevel>(level);
}

}  // namespace

KernelLevel kernel_level() {
  static const KernelLevel level = choose_level();
  return level;
}

const char* kernel_level_name() { return names[static_cast<std::size_t>(kernel_level())]; }

const char* kernel_arithmetic() { return kernel_level() == KernelLevel::x86_64_v2 ? "plain" : "fused"; }

#endif

}  // namespace geodrop
