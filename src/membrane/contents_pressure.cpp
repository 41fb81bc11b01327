#include "contents_pressure.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>

#include "outline.hpp"
#include "state/bearing_share.hpp"

namespace geodrop {

void ContentsPressure::update(const State<2>& state, const Grid<2>& grid, Membrane<2>& membrane) {
  const GridLayout<2>& layout = grid.layout;
  const Body<2>& body = find_named(state.bodies, membrane.body);
  if (body.stress[0].empty()) return;
  stress_.begin(layout, membrane);
  stress_.add(layout, body, [&](std::size_t p) {
    const double share = bearing_share(body, p);
    return std::array<double, 3>{share * body.stress[0][p], share * body.stress[1][p], share * body.stress[3][p]};
  });
  for (std::size_t k = 0; k < membrane.nodes(); ++k) {
    const auto sum = stress_.at(layout, membrane, k);
    const auto [xx, yy, xy] = sum.value;
    const auto [tx, ty] = tangent_at(membrane, k);
    const double pulled = xx * ty * ty + yy * tx * tx - 2 * xy * tx * ty;  // n . sigma n
    const double room = grid.taken.empty() ? sum.volume : std::max(sum.volume, stress_.room(grid, membrane, k));
    membrane.contents_pressure[k] = room > 0 ? std::max(0.0, -pulled / room) : 0.0;
  }
}

}  // namespace geodrop
