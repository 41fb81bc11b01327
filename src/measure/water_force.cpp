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

namespace {

/// Sum of pressures that push a membrane inwards.
std::array<double, 2> push(const Membrane<2>& membrane, const Array<double>& pressure) {
  const auto& [x, y] = membrane.x;
  const double sense = signed_area(x, y) > 0 ? 1 : -1;
  std::array<double, 2> force{};
  for (std::size_t s = 0; s < pressure.size(); ++s) {
    const std::size_t end = end_of_edge(s, membrane.nodes());
    force[0] -= sense * pressure[s] * (y[end] - y[s]);
    force[1] += sense * pressure[s] * (x[end] - x[s]);
  }
  return force;
}
std::array<double, 3> push(const Membrane<3>& membrane, const Array<double>& pressure) {
  std::array<double, 3> force{};
  for (std::size_t t = 0; t < pressure.size(); ++t) {
    const Vec<3> normal = 0.5 * normal_of(membrane, t);
    for (std::size_t a = 0; a < 3; ++a) force[a] -= pressure[t] * normal[static_cast<Eigen::Index>(a)];
  }
  return force;
}

}  // namespace

template <int Dim>
std::array<double, Dim> bed_force(const Membrane<Dim>& membrane) {
  return push(membrane, membrane.bed_pressure);
}

template std::array<double, 2> bed_force<2>(const Membrane<2>&);
template std::array<double, 3> bed_force<3>(const Membrane<3>&);

WaterForce water_force(const Membrane<2>& membrane) {
  const auto& [x, y] = membrane.x;
  WaterForce force{push(membrane, membrane.water_pressure), {}};
  for (std::size_t s = 0; s < membrane.segments(); ++s) {
    const std::size_t end = end_of_edge(s, membrane.nodes());
    const double dx = x[end] - x[s], dy = y[end] - y[s];
    force.friction[0] += membrane.water_shear[s] * dx;
    force.friction[1] += membrane.water_shear[s] * dy;
  }
  return force;
}

WaterForceInSpace water_force(const Membrane<3>& membrane) {
  WaterForceInSpace force;
  const auto& shear = membrane.triangles.water_shear;
  const std::array<double, 3> pressure = push(membrane, membrane.water_pressure);
  force.pressure = Vec<3>(pressure.data());
  for (std::size_t t = 0; t < shear[0].size(); ++t)
    force.friction += 0.5 * normal_of(membrane, t).norm() * vector_at(shear, t);
  return force;
}

}  // namespace geodrop
