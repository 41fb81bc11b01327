#include "initial_velocity.hpp"

#include <geodrop/solutions/exact.hpp>

#include <cmath>
#include <numbers>
#include <type_traits>

namespace geodrop {
namespace {

/// Of one point.
template <int Dim>
struct Motion {
  Vec<Dim> velocity = Vec<Dim>::Zero();                                                ///< [m/s]
  Eigen::Matrix<double, Dim, Dim> gradient = Eigen::Matrix<double, Dim, Dim>::Zero();  ///< dv_a/dx_b [1/s]
};

template <int Dim>
Motion<Dim> motion_at(const UniformVelocitySpec& uniform, const Vec<Dim>&) {
  return {Vec<Dim>(uniform.value.data())};
}

template <int Dim>
Motion<Dim> motion_at(const BarFirstModeSpec& bar, const Vec<Dim>& x) {
  Motion<Dim> motion;
  const double k = std::numbers::pi / (2 * bar.length);
  motion.velocity[bar.axis] = bar.amplitude * std::sin(k * x[bar.axis]);
  motion.gradient(bar.axis, bar.axis) = bar.amplitude * k * std::cos(k * x[bar.axis]);
  return motion;
}

template <int Dim>
Motion<Dim> motion_at(const LinearVelocitySpec& linear, const Vec<Dim>& x) {
  Motion<Dim> motion;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) {
      motion.gradient(a, b) = linear.gradient[a][b];
      motion.velocity[a] += linear.gradient[a][b] * (x[b] - linear.centre[b]);
    }
  return motion;
}

template <int Dim>
Motion<Dim> motion_at(const PulseVelocitySpec& pulse, const Vec<Dim>& x) {
  Motion<Dim> motion;
  const double away = x[pulse.axis] - pulse.centre[pulse.axis], k = std::numbers::pi / pulse.width;
  if (std::abs(away) >= pulse.width / 2) return motion;
  const double share = std::pow(std::cos(k * away), 2), slope = -k * std::sin(2 * k * away);
  for (int a = 0; a < Dim; ++a) {
    motion.velocity[a] = pulse.value[a] * share;
    motion.gradient(a, pulse.axis) = pulse.value[a] * slope;
  }
  return motion;
}

template <int Dim>
Motion<Dim> motion_at(const ExactSolution<Dim>& solution, const Vec<Dim>& x) {
  const ExactPoint<Dim> exact = exact_point<Dim>(solution, x, x, 0);
  return {exact.velocity, exact.velocity_gradient};
}

/// use(motion), with the motion of any point as motion(x).
template <int Dim, class Use>
void with_motion(const Scene& scene, const BodySpec& spec, Use&& use) {
  std::visit(
      [&](const auto& initial) {
        if constexpr (std::is_same_v<std::decay_t<decltype(initial)>, FromExactSpec>) {
          const ExactSolution<Dim> solution = exact_solution<Dim>(scene, spec.name);
          use([&](const Vec<Dim>& x) { return motion_at(solution, x); });
        } else {
          use([&](const Vec<Dim>& x) { return motion_at(initial, x); });
        }
      },
      spec.initial_velocity);
}

}  // namespace

template <int Dim>
void set_velocity(const Scene& scene, const BodySpec& spec, Body<Dim>& body) {
  with_motion<Dim>(scene, spec, [&](const auto& motion_of) {
    for (std::size_t p = 0; p < body.size(); ++p) {
      const Motion<Dim> motion = motion_of(vector_at(body.x, p));
      for (int a = 0; a < Dim; ++a) body.v[a][p] = motion.velocity[a];
      for (int c = 0; c < Dim * Dim; ++c) body.affine[c][p] = motion.gradient(c / Dim, c % Dim);
    }
  });
}

template <int Dim>
void set_velocity(const Scene& scene, const BodySpec& spec, Membrane<Dim>& membrane) {
  with_motion<Dim>(scene, spec, [&](const auto& motion_of) {
    for (std::size_t k = 0; k < membrane.nodes(); ++k) {
      const Vec<Dim> velocity = motion_of(vector_at(membrane.x, k)).velocity;
      for (int a = 0; a < Dim; ++a) membrane.v[a][k] = velocity[a];
    }
  });
}

template void set_velocity(const Scene&, const BodySpec&, Body<2>&);
template void set_velocity(const Scene&, const BodySpec&, Body<3>&);
template void set_velocity(const Scene&, const BodySpec&, Membrane<2>&);
template void set_velocity(const Scene&, const BodySpec&, Membrane<3>&);

}  // namespace geodrop
