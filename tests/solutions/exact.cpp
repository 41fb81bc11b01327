// Each exact solution against its own equations, by finite differences in space and time.
#include <geodrop/solutions/exact.hpp>

#include "materials/laws.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double pi = std::numbers::pi;

template <class Spec>
Material material(const Spec& spec) {
  MaterialSpec named;
  named.model = spec;
  return make_material(named);
}

template <int Dim>
Vec<Dim> random_point(std::mt19937& engine) {
  return Vec<Dim>::NullaryExpr([&](Eigen::Index) { return std::uniform_real_distribution<>(0.03, 0.97)(engine); });
}

/// df/ds at 0, fourth order.
template <class F>
auto slope(const F& f, double step) {
  return ((8.0 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step)).eval();
}

template <int Dim>
using Tensor = Eigen::Matrix<double, Dim, Dim>;

/// First Piola-Kirchhoff stress of the solution, F by differences of its displacement.
template <int Dim>
Tensor<Dim> piola(const ExactSolution<Dim>& solution, const NeoHookean& law, const Vec<Dim>& X, double t) {
  Tensor<Dim> F = Tensor<Dim>::Identity();
  for (int b = 0; b < Dim; ++b)
    F.col(b) +=
        slope([&](double s) { return exact_point<Dim>(solution, X + s * Vec<Dim>::Unit(b), X, t).displacement; }, 1e-3);
  Gradient<Dim, double> rows;
  for (int c = 0; c < Dim * Dim; ++c) rows[c] = F(c / Dim, c % Dim);
  const double J = F.determinant();
  CHECK(exact_point<Dim>(solution, X, X, t).volume_ratio == near(J, 1e-8));
  const auto s = neo_hookean_stress<Dim, double>(law, rows, J);
  Tensor<Dim> sigma;
  if constexpr (Dim == 2)
    sigma << s[0], s[3], s[3], s[1];
  else
    sigma << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return J * sigma * F.inverse().transpose();
}

/// Velocity and acceleration by differences in time, the force by the divergence of the stress: relative to the
/// largest.
template <int Dim, class Solution>
void check_driven(const NeoHookean& law, const Solution& solution, double period, const Vec<Dim>& shift) {
  const ExactSolution<Dim> any = solution;
  const double step = period / 2000, speed = velocity_scale<Dim>(any, 0), rate = 2 * pi / period;
  std::mt19937 engine(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec<Dim> X = random_point<Dim>(engine) + shift;
    const double t = period * random_point<1>(engine)[0];
    const auto at = [&](double s) { return exact_point<Dim>(any, X, X, t + s); };
    const Vec<Dim> velocity = slope([&](double s) { return at(s).displacement; }, step);
    CHECK((velocity - at(0).velocity).norm() < 1e-7 * speed);
    const Vec<Dim> acceleration = slope([&](double s) { return at(s).velocity; }, step);
    Vec<Dim> divergence = Vec<Dim>::Zero();
    for (int b = 0; b < Dim; ++b)
      divergence +=
          slope([&](double s) { return piola<Dim>(any, law, X + s * Vec<Dim>::Unit(b), t).col(b).eval(); }, 1e-3);
    const Vec<Dim> needed = acceleration - divergence / law.density;
    CHECK((body_force<Dim>(solution, X, t) - needed).norm() < 2e-6 * speed * rate);
  }
}

template <int Dim>
void check_mms() {
  const Material rubber = material(NeoHookeanSpec{1000, 1e7, 0.3});
  const ExactSolution<Dim> solution = make_exact<Dim>({"", AxisAlignedMmsSpec{0.05, 1.0}, {}}, rubber);
  const auto& mms = std::get<AxisAlignedMms>(solution);
  CHECK(mms.frequency == near(pi * 100, 1e-12));  // pi sqrt(E / rho)
  check_driven<Dim>(std::get<NeoHookean>(rubber), mms, 0.02, Vec<Dim>::Zero());
}

/// Points on all of the ring, which is as wide as the square in which they lie.
template <int Dim>
void check_vortex() {
  const Material rubber = material(NeoHookeanSpec{1000, 1000, 0.3});
  const ExactSolution<Dim> solution = make_exact<Dim>({"", GeneralizedVortexSpec{0.3, 1.0, 0.8, pi}, {}}, rubber);
  check_driven<Dim>(std::get<NeoHookean>(rubber), std::get<GeneralizedVortex>(solution), 2.0, Vec<Dim>::Zero());
}

ExactPoint<2> flow_at(const ExactSolution<2>& flow, const Vec<2>& x, double t) { return exact_point<2>(flow, x, x, t); }

}  // namespace

TEST_CASE("The body force of the manufactured solution closes the momentum equation, in 2D and 3D") {
  check_mms<2>();
  check_mms<3>();
}

TEST_CASE("The body force of the generalized vortex closes the momentum equation, in 2D and 3D") {
  check_vortex<2>();
  check_vortex<3>();
}

TEST_CASE("The generalized vortex turns circles as wholes and leaves all beyond its ring in place") {
  const Material rubber = material(NeoHookeanSpec{1000, 1000, 0.3});
  const ExactSolution<2> vortex = make_exact<2>({"", GeneralizedVortexSpec{0.3, 1.0, 0.25, pi}, {}}, rubber);
  const auto at = [&](const Vec<2>& X, double t) { return exact_point<2>(vortex, X, X, t); };
  CHECK(at({1, 0}, 0.5).displacement[0] == near(std::cos(0.3) - 1, 1e-12));  // the largest turn, after half a swing
  CHECK(at({1, 0}, 0.5).displacement[1] == near(std::sin(0.3), 1e-12));
  CHECK(at({0, 1}, 0).velocity[0] == near(-0.3 * pi, 1e-12));
  CHECK(at({0.3, 0.6}, 0.5).displacement.norm() == 0);
  CHECK(at({0.9, 0.9}, 0.5).displacement.norm() == 0);
  CHECK(body_force<2>(std::get<GeneralizedVortex>(vortex), {0.9, 0.9}, 0.5).norm() == 0);
  CHECK(velocity_scale<2>(vortex, 0) == near(0.3 * pi, 1e-12));
  // At t = 0 places have not moved yet, so that the gradient is one by X.
  const Vec<2> X{0.7, 0.8};
  for (int b = 0; b < 2; ++b) {
    const Vec<2> column = slope([&](double s) { return at(X + s * Vec<2>::Unit(b), 0).velocity; }, 1e-3);
    CHECK((at(X, 0).velocity_gradient.col(b) - column).norm() < 1e-6);
  }
}

TEST_CASE("The body force is the published one") {
  // Wallstedt & Guilkey (2008), unit length: b = pi^2 u (4 mu / rho - c^2 - 4 (lambda (ln J - 1) - mu) / (rho F^2)).
  const Material rubber = material(NeoHookeanSpec{1000, 1e7, 0.3});
  const auto& law = std::get<NeoHookean>(rubber);
  const ExactSolution<2> solution = make_exact<2>({"", AxisAlignedMmsSpec{0.05, 1.0}, {}}, rubber);
  const Vec<2> X{0.3, 0.8};
  const double t = 0.0037, c = 100, swing = 0.05 * std::sin(pi * c * t);
  const double u = swing * std::sin(2 * pi * 0.3), F = 1 + swing * 2 * pi * std::cos(2 * pi * 0.3);
  const double J = F * (1 - swing * 2 * pi * std::cos(2 * pi * 0.8));
  const double published = pi * pi * u *
                           (4 * law.shear_modulus / 1000 - c * c -
                            4 * (law.lame_lambda * (std::log(J) - 1) - law.shear_modulus) / (1000 * F * F));
  CHECK(body_force<2>(std::get<AxisAlignedMms>(solution), X, t)[0] == near(published, 1e-12));
}

TEST_CASE("Slip walls hold the manufactured solution") {
  const Material rubber = material(NeoHookeanSpec{1000, 1e7, 0.3});
  const ExactSolution<3> solution = make_exact<3>({"", AxisAlignedMmsSpec{0.1, 2.0}, {}}, rubber);
  for (const double wall : {0.0, 1.0, 2.0})
    for (int a = 0; a < 3; ++a) {
      Vec<3> X{0.3, 0.6, 0.8};
      X[a] = wall;
      CHECK(std::abs(exact_point<3>(solution, X, X, 0.004).displacement[a]) < 1e-15);
    }
}

TEST_CASE("Taylor-Green vortices satisfy Navier-Stokes and decay as tabulated") {
  // nu = 0.01, U = 1, one wave on 1 m; u_max and kinetic energy at t = 0.5 and 1 of the published table.
  const Material water = material(NewtonianSpec{1000, 4e5, 10});
  const ExactSolution<2> solution = make_exact<2>({"", TaylorGreenSpec{1.0, 1.0}, {}}, water);
  const auto& flow = std::get<TaylorGreen>(solution);
  CHECK(flow_at(solution, {0.25, 0.0}, 0.5).velocity[0] == near(0.6738254512, 1e-9));
  CHECK(flow_at(solution, {0.25, 0.0}, 1.0).velocity[0] == near(0.4540407387, 1e-9));
  CHECK(pressure<2>(flow, {0, 0}, 0.5) == near(1000 * 0.2270203694, 1e-9));
  CHECK(velocity_scale<2>(solution, 1.0) == near(0.4540407387 / std::sqrt(2.0), 1e-9));
  std::mt19937 engine(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec<2> x = random_point<2>(engine);
    const double t = 0.3;
    const ExactPoint<2> here = flow_at(solution, x, t);
    const Vec<2> rate = slope([&](double s) { return flow_at(solution, x, t + s).velocity; }, 1e-3);
    Vec<2> diffusion = Vec<2>::Zero(), force = Vec<2>::Zero();
    for (int b = 0; b < 2; ++b) {
      const auto along = [&](double s) -> Vec<2> { return x + s * Vec<2>::Unit(b); };
      const Vec<2> column = slope([&](double s) { return flow_at(solution, along(s), t).velocity; }, 1e-3);
      CHECK((here.velocity_gradient.col(b) - column).norm() < 1e-7);
      diffusion +=
          slope([&](double s) { return flow_at(solution, along(s), t).velocity_gradient.col(b).eval(); }, 1e-3);
      force[b] = -(pressure<2>(flow, along(1e-4), t) - pressure<2>(flow, along(-1e-4), t)) / 2e-4 / 1000;
    }
    CHECK(std::abs(here.velocity_gradient.trace()) < 1e-12);
    const Vec<2> residual = rate + here.velocity_gradient * here.velocity - force - 0.01 * diffusion;
    CHECK(residual.norm() < 1e-5);  // of terms of about 6 m/s2
  }
}

TEST_CASE("The pair of vortices satisfies Euler's equation within its circle and beyond, and is smooth across it") {
  const Material water = material(NewtonianSpec{1000, 4e5, 0});
  const double U = 0.5, a = 0.4;
  const ExactSolution<2> solution = make_exact<2>({"", LambDipoleSpec{U, a, {0.3, 0.5}}, {}}, water);
  const auto& pair = std::get<LambDipole>(solution);
  const double t = 0.3, step = 1e-3;
  const auto residual = [&](const Vec<2>& x) {
    const ExactPoint<2> here = flow_at(solution, x, t);
    Vec<2> sum = slope([&](double s) { return flow_at(solution, x, t + s).velocity; }, step);
    sum += here.velocity_gradient * here.velocity;
    for (int b = 0; b < 2; ++b) {
      const auto along = [&](double s) -> Vec<2> { return x + s * Vec<2>::Unit(b); };
      const Vec<2> column = slope([&](double s) { return flow_at(solution, along(s), t).velocity; }, step);
      CHECK((here.velocity_gradient.col(b) - column).norm() < 1e-6);  // of up to 7 / s
      sum[b] += (pressure<2>(pair, along(1e-4), t) - pressure<2>(pair, along(-1e-4), t)) / 2e-4 / 1000;
    }
    CHECK(std::abs(here.velocity_gradient.trace()) < 1e-12);
    return sum.norm();
  };
  std::mt19937 engine(4);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec<2> away = random_point<2>(engine) * 1.2 - Vec<2>(0.6, 0.6), x = centre_at<2>(pair, t) + away;
    if (std::abs(away.norm() - a) < 0.01) continue;  // the vorticity has a kink there
    CHECK(residual(x) < 1e-5);                       // of terms of about 5 m/s2
  }
  for (const double angle : {0.2, 1.3, 2.9}) {
    const Vec<2> out(std::cos(angle), std::sin(angle)), centre = centre_at<2>(pair, t);
    const Vec<2> x = centre + (a - 1e-9) * out, beyond = centre + (a + 1e-9) * out;
    CHECK((flow_at(solution, x, t).velocity - flow_at(solution, beyond, t).velocity).norm() < 1e-7);
    CHECK(pressure<2>(pair, x, t) == near(pressure<2>(pair, beyond, t), 1e-6));
  }
}

TEST_CASE("The pair of vortices has tabulated velocities, and carries its vortices along with it") {
  const Material water = material(NewtonianSpec{1000, 4e5, 0});
  const ExactSolution<2> solution = make_exact<2>({"", LambDipoleSpec{0.5, 0.4, {0.3, 0.5}}, {}}, water);
  const double k = 3.8317059702075123 / 0.4, j0 = -0.4027593957;  // J0 at the first zero of J1 (Abramowitz & Stegun)
  CHECK(flow_at(solution, {0.3, 0.5}, 0).velocity[0] == near(0.5 * (1 - 1 / j0), 1e-9));
  CHECK(flow_at(solution, {0.3, 0.5 + 0.4}, 0).velocity[0] == near(-0.5, 1e-9));  // the fluid beside streams back
  CHECK(flow_at(solution, {0.3 + 0.4, 0.5}, 0).velocity[0] == near(0.5, 1e-9));   // that in front is pushed
  CHECK(flow_at(solution, {0.3 + 4.0, 0.5}, 0).velocity[0] == near(0.005, 1e-9));
  CHECK(flow_at(solution, {0.3 + 1.0, 0.5}, 2).velocity[0] == near(0.5 * (1 - 1 / j0), 1e-9));
  // Where J1 is largest a particle moves with the pair; the vorticity there is -2 U k J1(1.8412) / J0, J1 = 0.58187.
  const Vec<2> core(0.3, 0.5 + 1.841183781 / k);
  const ExactPoint<2> there = flow_at(solution, core, 0);
  CHECK((there.velocity - Vec<2>(0.5, 0)).norm() < 1e-9);
  const double vorticity = there.velocity_gradient(1, 0) - there.velocity_gradient(0, 1);
  CHECK(vorticity == near(-2 * 0.5 * k * 0.5818652243 / j0, 1e-8));
  CHECK(velocity_scale<2>(solution, 1.0) == 0.5);
}

TEST_CASE("The bar's first mode satisfies the wave equation, is fixed at 0 and free of stress at its end") {
  const Material elastic = material(LinearElasticSpec{1.0, 100.0, 0.0});
  const ExactSolution<2> solution = make_exact<2>({"", BarFirstModeSpec{0.01, 1, 25.0}, {}}, elastic);
  CHECK(std::get<BarFirstMode>(solution).frequency == near(2 * pi / 10, 1e-12));  // period 4 L / c = 10 s
  const auto point = [&](double y, double t) { return exact_point<2>(solution, {3, y}, {3, y}, t); };
  CHECK(point(0, 1.7).displacement.norm() == 0);
  CHECK(point(25, 0).velocity[1] == near(0.01, 1e-12));
  CHECK(point(25, 1.7).volume_ratio == near(1, 1e-15));
  const double step = 1e-3, y = 11, t = 1.3;
  const auto u = [&](double at_y, double at_t) { return point(at_y, at_t).displacement[1]; };
  const double by_time = (u(y, t + step) - 2 * u(y, t) + u(y, t - step)) / (step * step);
  const double by_place = (u(y + step, t) - 2 * u(y, t) + u(y - step, t)) / (step * step);
  CHECK(by_time == near(100 * by_place, 1e-7));
  CHECK(point(y, t).velocity[1] == near((u(y, t + step) - u(y, t - step)) / (2 * step), 1.5e-7));
  CHECK(point(y, t).volume_ratio - 1 == near((u(y + step, t) - u(y - step, t)) / (2 * step), 1.5e-9));
}

TEST_CASE("A body in uniform motion keeps its stretch") {
  const Material elastic = material(LinearElasticSpec{1000, 1e6, 0.25});
  const ExactSolution<2> solution = make_exact<2>({"", UniformMotionSpec{{2.0, -1.0}, {1.11, 0.9}}, {}}, elastic);
  const ExactPoint<2> later = exact_point<2>(solution, {0, 0}, {0, 0}, 3);
  CHECK(later.displacement == Vec<2>(6, -3));
  CHECK(later.velocity == Vec<2>(2, -1));
  CHECK(later.volume_ratio == near(1.11 * 0.9, 1e-12));
  CHECK(strain_scale<2>(solution) == near(0.11, 1e-12));
  CHECK(velocity_scale<2>(solution, 3) == near(wave_speed(elastic), 1e-12));
}

TEST_CASE("The oscillating drop closes the momentum equation, keeps its energy sum, and swings as tabulated") {
  const Material water = material(NewtonianSpec{1000, 1.6e6, 0});
  const ExactSolution<2> solution = make_exact<2>({"", OscillatingDropSpec{1.0, 1.0, 2.0}, {}}, water);
  const auto& drop = std::get<OscillatingDrop>(solution);
  const double step = 1e-3;
  std::mt19937 engine(3);
  for (const double t : {0.3, 1.7, 4.0}) {
    const auto [a, rate] = shape_at(drop, t);
    CHECK((rate * rate + 1) * (a * a + 1 / (a * a)) == near(4, 4e-8));
    CHECK(pressure<2>(drop, {2 * a, 0}, t) == near_zero(1e-9));  // of 4 kPa
    CHECK(pressure<2>(drop, {0, 3 / a}, t) == 0);
    const Vec<2> X = random_point<2>(engine);
    const auto at = [&](double s) { return exact_point<2>(solution, X, Vec<2>::Zero(), t + s); };
    const Vec<2> x = X + at(0).displacement;
    const auto moving = [&](double s) -> Vec<2> { return X + at(s).displacement; };
    const Vec<2> velocity = slope(moving, step);
    CHECK((velocity - exact_point<2>(solution, X, x, t).velocity).norm() < 2e-6);
    const Vec<2> acceleration =
        slope([&](double s) { return exact_point<2>(solution, X, moving(s), t + s).velocity; }, step);
    Vec<2> needed = acceleration;
    for (int b = 0; b < 2; ++b)
      needed[b] +=
          (pressure<2>(drop, x + 1e-4 * Vec<2>::Unit(b), t) - pressure<2>(drop, x - 1e-4 * Vec<2>::Unit(b), t)) / 2e-4 /
          1000;
    CHECK((body_force<2>(drop, x, t) - needed).norm() < 1e-5);
  }
  CHECK(pressure<2>(drop, {0, 0}, 0) == near(4000, 1e-12));  // rho (A0^2 + B^2) R^2 / 2
  const double period = 4.827343;                            // of the table for A0 / B = 1
  CHECK(shape_at(drop, period).stretch == near(1, 3e-8));
  CHECK(shape_at(drop, period / 4).stretch == near(1.93185, 2e-6));
  CHECK(shape_at(drop, 3 * period / 4).stretch == near(1 / 1.93185, 2e-6));
  CHECK(velocity_scale<2>(solution, 1.0) == near(2 * std::sqrt(2.0), 1e-12));
}
