// The length of membrane that stands for a node.
#pragma once

#include "membrane/outline.hpp"

namespace geodrop {

/// Half of the segments beside a node [m]: unstretched, or of a membrane that slides as they are now, as its rest
/// length gathers where it is slack (1 m in a segment of 6 cm: contact 16 times too stiff for the step).
inline double node_length(const Membrane<2>& membrane, std::size_t k) {
  const std::size_t n = membrane.segments();
  const auto length = [&](std::size_t s) {
    return membrane.slides() ? segment_length(membrane, s) : membrane.rest_length[s];
  };
  double sum = k < n ? length(k) : 0.0;
  if (k > 0 || membrane.closed) sum += length(k > 0 ? k - 1 : n - 1);
  return 0.5 * sum;
}

}  // namespace geodrop
