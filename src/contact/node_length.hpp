// The length of membrane that stands for a node.
#pragma once

#include <geodrop/state/state.hpp>

namespace geodrop {

/// Half of the segments beside a node, unstretched [m].
template <int Dim>
double node_length(const Membrane<Dim>& membrane, std::size_t k) {
  const std::size_t n = membrane.segments();
  double sum = k < n ? membrane.rest_length[k] : 0.0;
  if (k > 0 || membrane.closed) sum += membrane.rest_length[k > 0 ? k - 1 : n - 1];
  return 0.5 * sum;
}

}  // namespace geodrop
