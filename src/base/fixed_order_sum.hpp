// Sums over particles whose bits do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <vector>

namespace geodrop {

/// Adds up `add(sums, p)` for p = 0..count-1 by chunks of fixed size, then the chunks in order. `Sums` starts from its
/// default value and has `+=`.
template <class Sums, class Add>
Sums fixed_order_sum(std::size_t count, const Add& add) {
  constexpr std::size_t chunk = 4096;
  const std::size_t chunks = (count + chunk - 1) / chunk;
  std::vector<Sums> parts(chunks);
#pragma omp parallel for schedule(static) if (chunks > 1)
  for (std::size_t c = 0; c < chunks; ++c) {
    Sums part{};
    const std::size_t end = count < (c + 1) * chunk ? count : (c + 1) * chunk;
    for (std::size_t p = c * chunk; p < end; ++p) add(part, p);
    parts[c] = part;
  }
  Sums sums{};
  for (const Sums& part : parts) sums += part;
  return sums;
}

}  // namespace geodrop
