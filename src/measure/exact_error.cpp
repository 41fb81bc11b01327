// How far a body is from the exact solution that it follows.
#include <algorithm>
#include <cmath>
#include <geodrop/grid/grid.hpp>
#include <geodrop/measure/measure.hpp>
#include <geodrop/solutions/exact.hpp>
#include <limits>
#include <numbers>
#include <tuple>

#include "base/fixed_order_sum.hpp"
#include "grid/bases.hpp"
#include "spread.hpp"

namespace geodrop {
namespace {

struct ErrorSums {
  Spread velocity, displacement, strain, pressure, exact_pressure;
  double kinetic = 0, exact_kinetic = 0;
  double mode = 0, mode_displacement = 0, mode_velocity = 0;  ///< sums of m phi^2, m u phi, m v phi

  ErrorSums& operator+=(const ErrorSums& other) {
    velocity += other.velocity;
    displacement += other.displacement;
    strain += other.strain;
    pressure += other.pressure;
    exact_pressure += other.exact_pressure;
    kinetic += other.kinetic;
    exact_kinetic += other.exact_kinetic;
    mode += other.mode;
    mode_displacement += other.mode_displacement;
    mode_velocity += other.mode_velocity;
    return *this;
  }
};

/// A displacement less the whole periods that lie in it.
template <int Dim>
Vec<Dim> without_periods(const GridLayout<Dim>& layout, Vec<Dim> d) {
  for (int a = 0; a < Dim; ++a) {
    const double period = layout.upper[a] - layout.lower[a];
    if (layout.periodic(a)) d[a] -= period * std::round(d[a] / period);
  }
  return d;
}

/// A place, or of a pair of vortices that has moved on the image of the place that is nearest to it.
template <int Dim>
Vec<Dim> seen_from(const ExactSolution<Dim>& solution, const GridLayout<Dim>& layout, double t, const Vec<Dim>& x) {
  const auto* pair = std::get_if<LambDipole>(&solution);
  if (!pair) return x;
  const Vec<Dim> centre = centre_at<Dim>(*pair, t);
  return centre + without_periods<Dim>(layout, x - centre);
}

template <int Dim>
void add_particle(const ExactSolution<Dim>& solution, const GridLayout<Dim>& layout, double t, const Body<Dim>& body,
                  std::size_t p, ErrorSums& sums) {
  const Vec<Dim> v = vector_at(body.v, p), X = vector_at(body.initial_x, body.id[p]);
  const Vec<Dim> x = seen_from<Dim>(solution, layout, t, vector_at(body.x, p));
  const ExactPoint<Dim> exact = exact_point<Dim>(solution, X, x, t);
  sums.velocity.add((v - exact.velocity).squaredNorm());
  sums.displacement.add(without_periods<Dim>(layout, x - X - exact.displacement).squaredNorm());
  sums.strain.add(std::pow(body.J[p] - exact.volume_ratio, 2));
  sums.kinetic += body.mass[p] * v.squaredNorm();
  sums.exact_kinetic += body.mass[p] * exact.velocity.squaredNorm();
  const auto add_pressure = [&](double told) {
    sums.pressure.add(std::pow(mean_pressure(body, p) - told, 2));
    sums.exact_pressure.add(told * told);
  };
  if (const auto* flow = std::get_if<TaylorGreen>(&solution)) add_pressure(pressure<Dim>(*flow, x, t));
  if (const auto* pair = std::get_if<LambDipole>(&solution)) add_pressure(pressure<Dim>(*pair, x, t));
  if (const auto* bar = std::get_if<BarFirstMode>(&solution)) {
    const double shape = std::sin(bar->wave_number * X[bar->axis]), m = body.mass[p];
    sums.mode += m * shape * shape;
    sums.mode_displacement += m * shape * (x - X)[bar->axis];
    sums.mode_velocity += m * shape * v[bar->axis];
  }
}

/// Along one axis the three nodes that a particle reaches, folded at walls and wrapped at seams: those of quadratic
/// splines whatever the basis, so that densities compare.
template <int Dim>
void find_nodes(const GridLayout<Dim>& layout, int axis, double x, std::array<int, 3>& node, double* weight) {
  x = layout.wrapped(axis, x);
  const int base = layout.base(axis, x), cells = layout.cells[axis];
  const ThreeWeights at_node = layout.graded() ? GradedBspline2::at(layout.knots[axis][base + GridLayout<Dim>::pad], x)
                                               : Bspline2::at((x - layout.lower[axis]) * layout.inv_h - base, 0);
  weight[0] = at_node.w0;
  weight[1] = at_node.w1;
  weight[2] = at_node.w2;
  for (int i = 0; i < 3; ++i) {
    const int n = base + i - 1;
    node[i] = layout.periodic(axis) ? (n + cells) % cells : n < 0 ? -n : n > cells ? 2 * cells - n : n;
  }
}

/// Mass of each node over that of a node amid material of reference density: least and largest.
template <int Dim>
std::pair<double, double> node_densities(const GridLayout<Dim>& layout, const Body<Dim>& body) {
  std::vector<double> mass(layout.nodes(), 0.0);
  for (std::size_t p = 0; p < body.size(); ++p) {
    std::array<std::array<int, 3>, Dim> node;
    double weight[Dim][3];
    for (int a = 0; a < Dim; ++a) find_nodes<Dim>(layout, a, body.x[a][p], node[a], weight[a]);
    for (int k = 0; k < (Dim == 2 ? 9 : 27); ++k) {
      std::array<int, Dim> at_node;
      double share = body.mass[p];
      for (int a = 0, rest = k; a < Dim; rest /= 3, ++a) {
        at_node[a] = node[a][rest % 3];
        share *= weight[a][rest % 3];
      }
      mass[layout.index(at_node)] += share;
    }
  }
  std::pair<double, double> found{std::numeric_limits<double>::infinity(), 0.0};
  const int count = layout.nodes();
  for (int flat = 0; flat < count; ++flat) {
    double full = reference_density(body.material);
    bool real = true;
    for (int a = 0; a < Dim; ++a) {
      const int n = flat / layout.stride[a] % layout.stored[a] - GridLayout<Dim>::pad;
      const bool periodic = layout.periodic(a);
      real = real && n >= 0 && n <= layout.cells[a] - (periodic ? 1 : 0);
      full *= layout.h * layout.spline_width(a, std::clamp(n, 0, layout.cells[a])) *
              (!periodic && (n == 0 || n == layout.cells[a]) ? 0.5 : 1.0);
    }
    if (!real) continue;
    found.first = std::min(found.first, mass[flat] / full);
    found.second = std::max(found.second, mass[flat] / full);
  }
  return found;
}

}  // namespace

template <int Dim>
ExactError exact_error(const Scene& scene, const State<Dim>& state, const Body<Dim>& body) {
  const ExactSolution<Dim> solution = exact_solution<Dim>(scene, body.name);
  const GridLayout<Dim> layout(scene.grid, scene.walls);
  const auto sums = fixed_order_sum<ErrorSums>(body.size(), [&](ErrorSums& part, std::size_t p) {
    add_particle<Dim>(solution, layout, state.t, body, p, part);
  });
  const std::size_t n = body.size();
  const double speed = velocity_scale<Dim>(solution, state.t), strain = strain_scale<Dim>(solution);
  ExactError error;
  error.velocity_rms = sums.velocity.rms(n) / speed;
  error.velocity_max = sums.velocity.max() / speed;
  error.displacement_rms = sums.displacement.rms(n);
  error.displacement_max = sums.displacement.max();
  error.strain_rms = sums.strain.rms(n) / strain;
  error.strain_max = sums.strain.max() / strain;
  if (std::holds_alternative<TaylorGreen>(solution) || std::holds_alternative<LambDipole>(solution)) {
    error.kinetic_energy = sums.kinetic / sums.exact_kinetic;
    error.pressure_rms = std::sqrt(sums.pressure.square / sums.exact_pressure.square);
    std::tie(error.density_min, error.density_max) = node_densities(layout, body);
  }
  if (const auto* bar = std::get_if<BarFirstMode>(&solution)) {
    const double u = bar->frequency * sums.mode_displacement / sums.mode / bar->amplitude;
    const double v = sums.mode_velocity / sums.mode / bar->amplitude;
    error.mode_energy = u * u + v * v;
    error.phase = std::remainder(std::atan2(u, v) - bar->frequency * state.t, 2 * std::numbers::pi);
  }
  return error;
}

template ExactError exact_error<2>(const Scene&, const State<2>&, const Body<2>&);
template ExactError exact_error<3>(const Scene&, const State<3>&, const Body<3>&);

}  // namespace geodrop
