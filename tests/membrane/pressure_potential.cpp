// The potential of pressures on membranes: of a square by hand, and its slope is the load.
#include "membrane/pressure_potential.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "support/near.hpp"
#include "support/small_state.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

State<2> square() {
  State<2> state;
  state.membranes = {square_membrane()};  // of side 2 around (4, 4)
  for (auto& component : state.membranes[0].load) component.assign(4, 0.0);
  return state;
}

/// A closed tetrahedron of the volume 1/6.
State<3> tetrahedron(double gauge_pressure) {
  Membrane<3> bag;
  bag.name = "bag";
  bag.x = {Array<double>{0, 1, 0, 0}, Array<double>{0, 0, 1, 0}, Array<double>{0, 0, 0, 1}};
  bag.mass.assign(4, 1.0);
  for (const auto& t : {std::array<std::uint32_t, 3>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    for (std::size_t k = 0; k < 3; ++k) bag.triangles.corner[k].push_back(t[k]);
    bag.triangles.rest_area.push_back(1);
  }
  bag.triangles.gauge_pressure = gauge_pressure;
  for (auto& component : bag.load) component.assign(4, 0.0);
  State<3> state;
  state.membranes = {bag};
  return state;
}

/// Central differences of the potential against the loads, over all nodes and axes, over the largest load [-].
template <int Dim>
double slope_error(const std::vector<StillFluid>& fluids, State<Dim> state) {
  constexpr double off = 1e-4;
  State<Dim> loaded = state;
  if constexpr (Dim == 2) add_still_fluids(fluids, loaded);
  if constexpr (Dim == 3) add_surface_pressure(fluids, loaded);
  double error = 0, largest = 0;
  for (int a = 0; a < Dim; ++a)
    for (std::size_t k = 0; k < state.membranes[0].nodes(); ++k) {
      double& x = state.membranes[0].x[a][k];
      const double at = x, load = loaded.membranes[0].load[a][k];
      x = at + off;
      const double ahead = pressure_potential(fluids, state);
      x = at - off;
      const double slope = (ahead - pressure_potential(fluids, state)) / (2 * off);
      x = at;
      error = std::max(error, std::abs(slope + load));
      largest = std::max(largest, std::abs(load));
    }
  return error / largest;
}

}  // namespace

TEST_CASE("A square under a still fluid has the potential of the pressure over its wet area, in either sense") {
  State<2> state = square();
  const std::vector<StillFluid> fluids{{state.membranes[0].name, -1e4, 4.2}};
  CHECK(pressure_potential(fluids, state) == near(1e4 * 2 * 1.2 * 1.2 / 2, 1e-12));  // gamma b d^2 / 2
  for (auto& component : state.membranes[0].x) std::reverse(component.begin(), component.end());
  CHECK(pressure_potential(fluids, state) == near(1e4 * 2 * 1.2 * 1.2 / 2, 1e-12));
  for (double& y : state.membranes[0].x[1]) y += 10;
  CHECK(pressure_potential(fluids, state) == 0);
  CHECK(pressure_potential({}, square()) == 0);
}

TEST_CASE("A gauge pressure has -p V, in space") {
  CHECK(pressure_potential({}, tetrahedron(6000)) == near(-1000, 1e-12));
}

TEST_CASE("Its slope is the load, of still fluids that cut the membrane or cover it and of gauge pressures") {
  State<2> slanted = square();
  slanted.membranes[0].x[0] = {3.1, 5.2, 4.8, 2.7};
  slanted.membranes[0].x[1] = {2.9, 3.4, 5.1, 4.6};
  for (const double surface : {3.2, 4.0, 9.0})
    CHECK(slope_error<2>({{slanted.membranes[0].name, -1e4, surface}}, slanted) < 1e-6);
  for (const double surface : {0.3, 2.0})
    for (const double unit_weight : {-1e4, 1e4})
      CHECK(slope_error<3>({{"bag", unit_weight, surface}}, tetrahedron(0)) < 1e-6);
  CHECK(slope_error<3>({{"bag", -1e4, 0.3}}, tetrahedron(6000)) < 1e-6);
}
