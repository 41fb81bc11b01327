#include "membrane_balance.hpp"

#include <algorithm>
#include <cmath>

#include "membrane/outline.hpp"

namespace geodrop {

double friction_ratio(const Membrane<2>& membrane, double gravity) {
  constexpr double least_change = 1;  // [N/m]
  const Array<double>& shear = shear_on_cloth(membrane);
  double largest = 0;
  const std::size_t first = membrane.closed ? 0 : 1, end = membrane.closed ? membrane.nodes() : membrane.segments();
  for (std::size_t k = first; k < end; ++k) {
    const std::size_t behind = node_before(membrane, k);  // also the segment before the node
    const double length = 0.5 * (segment_length(membrane, behind) + segment_length(membrane, k));
    const double change = std::abs(membrane.tension[k] - membrane.tension[behind]);
    double given = membrane.contents_friction * membrane.contents_pressure[k] * length + gravity * membrane.mass[k];
    if (!shear.empty())
      given += 0.5 * (std::abs(shear[behind]) * segment_length(membrane, behind) +
                      std::abs(shear[k]) * segment_length(membrane, k));
    if (!membrane.load[0].empty()) given += std::hypot(membrane.load[0][k], membrane.load[1][k]);
    if (change > least_change) largest = std::max(largest, change / std::max(given, least_change));
  }
  return largest;
}

}  // namespace geodrop
