#include "water_force.hpp"

#include <numeric>

#include "geometry/polygon.hpp"
#include "membrane/outline.hpp"
#include "membrane/part_size.hpp"
#include "membrane/triangles.hpp"

namespace geodrop {

template <int Dim>
double seepage(const Membrane<Dim>& membrane) {
  double sum = 0;
  for (std::size_t s = 0; s < membrane.seepage.size(); ++s) sum += membrane.seepage[s] * size_of(membrane, s);
  return sum;
}

template <int Dim>
double water_inside(const Body<Dim>& water) {
  return std::accumulate(water.mass.begin(), water.mass.end(), 0.0) / reference_density(water.material);
}

template double water_inside(const Body<2>&);
template double water_inside(const Body<3>&);
template double seepage(const Membrane<2>&);
template double seepage(const Membrane<3>&);

WaterForce water_force(const Membrane<2>& membrane) {
  const auto& [x, y] = membrane.x;
  const double sense = signed_area(x, y) > 0 ? 1 : -1;
  WaterForce force;
  for (std::size_t s = 0; s < membrane.segments(); ++s) {
    const std::size_t end = end_of_edge(s, membrane.nodes());
    const double dx = x[end] - x[s], dy = y[end] - y[s];
    force.pressure[0] -= sense * membrane.water_pressure[s] * dy;
    force.pressure[1] += sense * membrane.water_pressure[s] * dx;
    force.friction[0] += membrane.water_shear[s] * dx;
    force.friction[1] += membrane.water_shear[s] * dy;
  }
  return force;
}

WaterForceInSpace water_force(const Membrane<3>& membrane) {
  WaterForceInSpace force;
  const auto& shear = membrane.triangles.water_shear;
  for (std::size_t t = 0; t < membrane.water_pressure.size(); ++t) {
    const Vec<3> normal = 0.5 * normal_of(membrane, t);
    force.pressure -= membrane.water_pressure[t] * normal;
    if (!shear[0].empty()) force.friction += normal.norm() * vector_at(shear, t);
  }
  return force;
}

}  // namespace geodrop
