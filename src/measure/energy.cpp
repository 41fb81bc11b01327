// Energies, mass, momentum of the whole, and the error of a pressure field.
#include <algorithm>
#include <cmath>
#include <geodrop/measure/measure.hpp>
#include <numeric>

#include "base/fixed_order_sum.hpp"
#include "materials/neo_hookean.hpp"
#include "materials/pore_gas.hpp"
#include "membrane/triangles.hpp"
#include "spread.hpp"
#include "state/bearing_share.hpp"

namespace geodrop {
namespace {

/// Energy of a point mass: m v^2 / 2 - m g.x.
template <int Dim>
void add_mass(Totals<Dim>& sums, double mass, const std::array<Array<double>, Dim>& x,
              const std::array<Array<double>, Dim>& v, const Point& gravity, std::size_t p) {
  sums.mass += mass;
  for (int a = 0; a < Dim; ++a) {
    sums.kinetic += 0.5 * mass * v[a][p] * v[a][p];
    sums.potential -= mass * gravity[a] * x[a][p];
    sums.momentum[a] += mass * v[a][p];
  }
}

/// A viscous stress stores nothing.
template <int Dim>
double strain_energy(const Newtonian& fluid, const Body<Dim>& body, std::size_t p) {
  return body.mass[p] / fluid.density *
         fluid_energy(fluid, body.J[p], body.gas_at(p), fluid.of_weight(body.x[vertical_axis<Dim>][p]));
}

/// p^2 / 2K + s:s / 4G per volume that bears, of effective stresses, and u^2 / 2K_w of the pores.
template <class Solid, int Dim>
double strain_energy(const Solid& solid, const Body<Dim>& body, std::size_t p) {
  const double mean = (body.stress[0][p] + body.stress[1][p] + body.stress[2][p]) / 3;
  double deviator_square = 0;
  for (int k = 0; k < 3; ++k) deviator_square += (body.stress[k][p] - mean) * (body.stress[k][p] - mean);
  for (int k = 3; k < stress_components<Dim>; ++k) deviator_square += 2 * body.stress[k][p] * body.stress[k][p];
  const double skeleton = bearing_share(body, p) * body.volume(p) *
                          (mean * mean / (2 * solid.bulk_modulus) + deviator_square / (4 * solid.shear_modulus));
  if constexpr (requires { solid.pore_stiffness; }) {
    if (body.pore_pressure.empty() || solid.pore_stiffness <= 0) return skeleton;
    const double u = body.pore_pressure[p];
    if constexpr (std::is_same_v<Solid, MohrCoulombWithGas>)
      return skeleton + body.volume(p) / body.J[p] * gas_pore_energy(solid, u);
    return skeleton + body.volume(p) * u * u / (2 * solid.pore_stiffness);
  }
  return skeleton;
}

template <int Dim>
double strain_energy(const NeoHookean& solid, const Body<Dim>& body, std::size_t p) {
  std::array<double, Dim * Dim> F;
  for (int c = 0; c < Dim * Dim; ++c) F[c] = body.deformation[c][p];
  return body.mass[p] / solid.density * neo_hookean_energy<Dim>(solid, F, body.J[p]);
}

template <int Dim>
Totals<Dim> body_totals(const Body<Dim>& body, const Point& gravity) {
  const auto sum = [&](const auto& law) {
    return fixed_order_sum<Totals<Dim>>(body.size(), [&](Totals<Dim>& sums, std::size_t p) {
      add_mass<Dim>(sums, body.mass[p], body.x, body.v, gravity, p);
      sums.strain += strain_energy(law, body, p);
    });
  };
  return std::visit(sum, body.material);
}

/// J e^2 / 2 per rest length where it is stretched; momentum with what goes to its nodes at the next step.
template <int Dim>
Totals<Dim> membrane_totals(const Membrane<Dim>& membrane, const Point& gravity) {
  Totals<Dim> sums;
  for (std::size_t i = 0; i < membrane.nodes(); ++i)
    add_mass<Dim>(sums, membrane.mass[i], membrane.x, membrane.v, gravity, i);
  for (int a = 0; a < Dim; ++a)
    sums.momentum[a] += std::accumulate(membrane.caught[a].begin(), membrane.caught[a].end(), 0.0);
  if constexpr (Dim == 3) sums.membrane = cloth_energy(membrane);
  for (std::size_t s = 0; s < membrane.segments(); ++s) {
    const double stretch = std::max(0.0, membrane.strain[s]);
    sums.membrane += 0.5 * membrane.axial_stiffness * stretch * stretch * membrane.rest_length[s];
  }
  return sums;
}

}  // namespace

template <int Dim>
Totals<Dim>& Totals<Dim>::operator+=(const Totals& other) {
  kinetic += other.kinetic;
  potential += other.potential;
  strain += other.strain;
  membrane += other.membrane;
  mass += other.mass;
  momentum += other.momentum;
  return *this;
}

template <int Dim>
Totals<Dim> measure(const State<Dim>& state, const Point& gravity) {
  Totals<Dim> totals;
  for (const Body<Dim>& body : state.bodies)
    if (body.field != waiting) totals += body_totals(body, gravity);
  for (const Membrane<Dim>& membrane : state.membranes)
    if (membrane.field != waiting) totals += membrane_totals(membrane, gravity);
  for (const Anchor<Dim>& anchor : state.anchors)
    if (anchor.line) totals.membrane += 0.5 * anchor.compliance * Vec<Dim>(anchor.force.data()).squaredNorm();
  return totals;
}

template <int Dim>
double kinetic_energy(const State<Dim>& state) {
  const auto square = [](const auto& v, std::size_t p) {
    double sum = 0;
    for (const auto& component : v) sum += component[p] * component[p];
    return sum;
  };
  double twice = 0;
  for (const Body<Dim>& body : state.bodies)
    if (body.field != waiting)
      twice += fixed_order_sum<double>(body.size(),
                                       [&](double& sum, std::size_t p) { sum += body.mass[p] * square(body.v, p); });
  for (const Membrane<Dim>& membrane : state.membranes)
    for (std::size_t k = 0; k < membrane.nodes(); ++k) twice += membrane.mass[k] * square(membrane.v, k);
  return twice / 2;
}

template <int Dim>
PressureError pressure_error(const Body<Dim>& body, const Newtonian& fluid, double surface, double gravity) {
  const auto sums = fixed_order_sum<Spread>(body.size(), [&](Spread& part, std::size_t p) {
    const double depth = surface - body.x[vertical_axis<Dim>][p];
    const double error = mean_pressure(body, p) - still_pressure(fluid, gravity, depth);
    part.add(error * error);
  });
  return {sums.rms(body.size()), sums.max()};
}

template struct Totals<2>;
template struct Totals<3>;
template Totals<2> measure(const State<2>&, const Point&);
template Totals<3> measure(const State<3>&, const Point&);
template double kinetic_energy(const State<2>&);
template double kinetic_energy(const State<3>&);
template PressureError pressure_error(const Body<2>&, const Newtonian&, double, double);
template PressureError pressure_error(const Body<3>&, const Newtonian&, double, double);

}  // namespace geodrop
