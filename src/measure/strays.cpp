#include "strays.hpp"

#include <geodrop/measure/measure.hpp>

#include "base/fixed_order_sum.hpp"
#include "geometry/polygon.hpp"

namespace geodrop {

double strays_inside(const State<2>& state, const Membrane<2>& membrane, const std::string& pore_water) {
  const MembraneMeasures<2> around = measure(membrane);
  double volume = 0;
  for (const Body<2>& body : state.bodies) {
    if (body.name == membrane.body || body.name == pore_water || body.field == waiting) continue;
    volume += fixed_order_sum<double>(body.size(), [&](double& sum, std::size_t p) {
      const Vec<2> x = vector_at(body.x, p);
      const bool in_box = (x.array() > around.lower.array()).all() && (x.array() < around.upper.array()).all();
      if (in_box && winding_number(membrane.x[0], membrane.x[1], x) != 0) sum += body.volume(p);
    });
  }
  return volume;
}

}  // namespace geodrop
