#include "front_probe.hpp"

#include <algorithm>
#include <cmath>

namespace geodrop {
namespace {

/// Volume of the body over the width of each column of cells [m].
std::vector<double> thickness_of_columns(const GridSpec& grid, const Body<2>& body) {
  const auto columns = static_cast<std::ptrdiff_t>(std::lround((grid.upper[0] - grid.lower[0]) / grid.spacing));
  std::vector<double> thickness(static_cast<std::size_t>(columns), 0.0);
  for (std::size_t p = 0; p < body.size(); ++p) {
    const auto column = static_cast<std::ptrdiff_t>(std::floor((body.x[0][p] - grid.lower[0]) / grid.spacing));
    thickness[std::clamp<std::ptrdiff_t>(column, 0, columns - 1)] += body.volume(p) / grid.spacing;
  }
  return thickness;
}

/// Columns from the first one on, as far as they are thick enough; where the thickness is just `least`.
template <class Iterator>
double columns_to_front(Iterator first, Iterator end, double least) {
  const Iterator below = std::find_if(first, end, [least](double thickness) { return thickness < least; });
  const auto whole = static_cast<double>(below - first);
  if (below == end) return whole - 0.5;
  const double last = *std::prev(below);
  return whole - 1 + (last - least) / (last - *below);
}

}  // namespace

HeapFronts heap_fronts(const GridSpec& grid, const FrontProbeSpec& probe, const Body<2>& body) {
  const std::vector<double> thickness = thickness_of_columns(grid, body);
  const auto thickest = std::max_element(thickness.begin(), thickness.end());
  const double middle = grid.lower[0] + (static_cast<double>(thickest - thickness.begin()) + 0.5) * grid.spacing;
  if (!(*thickest >= probe.thickness)) return {middle, middle};
  return {middle - grid.spacing *
                       columns_to_front(std::make_reverse_iterator(thickest + 1), thickness.rend(), probe.thickness),
          middle + grid.spacing * columns_to_front(thickest, thickness.end(), probe.thickness)};
}

}  // namespace geodrop
