// A root of a function of one variable between two points where its signs differ.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace geodrop {

/// Ridders (1979): as safe as bisection, and the number of right digits doubles with every two evaluations where the
/// function is smooth. f(a) and f(b) must differ in sign. The root to some 1e-15 of max(1, |root|).
template <class Function>
double find_root(const Function& f, double a, double b) {
  constexpr int most_rounds = 200;  // bisection alone needs 60 from the widest bracket
  double f_a = f(a), f_b = f(b), root = a;
  if (f_a == 0) return a;
  if (f_b == 0) return b;
  const auto tolerance = [](double x) {
    return 4 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(x));
  };
  for (int round = 0; round < most_rounds; ++round) {
    const double middle = (a + b) / 2, f_middle = f(middle);
    if (f_middle == 0) return middle;
    // f_a and f_b differ in sign, so that the square root is of a positive number.
    const double shift = (middle - a) * f_middle / std::sqrt(f_middle * f_middle - f_a * f_b);
    const double next = middle + (f_a > f_b ? shift : -shift), before = root;
    root = next;
    if (std::abs(next - before) <= tolerance(next) || std::abs(b - a) <= tolerance(next)) return next;
    const double f_next = f(next);
    if (f_next == 0) return next;
    if (std::signbit(f_middle) != std::signbit(f_next)) {
      a = middle, f_a = f_middle;
      b = next, f_b = f_next;
    } else if (std::signbit(f_a) != std::signbit(f_next)) {
      b = next, f_b = f_next;
    } else {
      a = next, f_a = f_next;
    }
  }
  return root;
}

}  // namespace geodrop
