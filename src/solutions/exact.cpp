#include <geodrop/solutions/exact.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace geodrop {
namespace {

constexpr double pi = std::numbers::pi;

double phase(int axis) { return axis == 1 ? pi : 0.0; }

// --- From the scene ----------------------------------------------------------------------------

template <int Dim>
ExactSolution<Dim> make(const AxisAlignedMmsSpec& spec, const Material& material) {
  const auto& solid = std::get<NeoHookean>(material);
  const double lambda = solid.lame_lambda, mu = solid.shear_modulus;
  const double youngs_modulus = mu * (3 * lambda + 2 * mu) / (lambda + mu);
  return AxisAlignedMms{spec.amplitude,
                        2 * pi / spec.length,
                        pi / spec.length * std::sqrt(youngs_modulus / solid.density),
                        solid.density,
                        lambda,
                        mu};
}

template <int Dim>
ExactSolution<Dim> make(const TaylorGreenSpec& spec, const Material& material) {
  const auto& fluid = std::get<Newtonian>(material);
  return TaylorGreen{spec.speed, 2 * pi / spec.length, fluid.viscosity / fluid.density, fluid.density,
                     fluid.bulk_modulus};
}

template <int Dim>
ExactSolution<Dim> make(const UniformMotionSpec& spec, const Material& material) {
  UniformMotion<Dim> motion;
  for (int a = 0; a < Dim; ++a) {
    motion.velocity[a] = spec.velocity[a];
    motion.stretch[a] = spec.stretch[a];
  }
  motion.wave_speed = wave_speed(material);
  return motion;
}

template <int Dim>
ExactSolution<Dim> make(const BarFirstModeSpec& spec, const Material& material) {
  const double wave_number = pi / (2 * spec.length);
  return BarFirstMode{spec.amplitude, spec.axis, wave_number, wave_number * wave_speed(material)};
}

template <int Dim>
ExactSolution<Dim> make(const GeneralizedVortexSpec& spec, const Material& material) {
  const auto& solid = std::get<NeoHookean>(material);
  return GeneralizedVortex{spec.angle, spec.radius, spec.half_width, spec.frequency,
                           solid.shear_modulus / solid.density};
}

template <int Dim>
ExactSolution<Dim> make(const OscillatingDropSpec& spec, const Material& material) {
  const auto& fluid = std::get<Newtonian>(material);
  return OscillatingDrop{spec.rate, spec.frequency, spec.radius, fluid.density, fluid.bulk_modulus};
}

template <int Dim>
ExactSolution<Dim> make(const LambDipoleSpec& spec, const Material& material) {
  const auto& fluid = std::get<Newtonian>(material);
  return LambDipole{spec.speed, spec.radius, spec.centre, fluid.density, fluid.bulk_modulus};
}

// --- Of one point ------------------------------------------------------------------------------

struct AlongAxis {
  double displacement, stretch;  ///< [m], [-]
};
AlongAxis along_axis(const AxisAlignedMms& mms, int axis, double X, double t) {
  const double k = mms.wave_number, swing = mms.amplitude * std::sin(mms.frequency * t + phase(axis));
  return {swing * std::sin(k * X), 1 + swing * k * std::cos(k * X)};
}

/// What is left of the speed of the vortices [m/s].
double speed_at(const TaylorGreen& flow, double t) {
  return flow.speed * std::exp(-2 * flow.viscosity * flow.wave_number * flow.wave_number * t);
}

template <int Dim>
ExactPoint<Dim> point(const AxisAlignedMms& mms, const Vec<Dim>& X, const Vec<Dim>&, double t) {
  ExactPoint<Dim> out;
  const double k = mms.wave_number, omega = mms.frequency;
  for (int a = 0; a < Dim; ++a) {
    const AlongAxis now = along_axis(mms, a, X[a], t);
    const double speed = mms.amplitude * omega * std::cos(omega * t + phase(a));
    out.displacement[a] = now.displacement;
    out.velocity[a] = speed * std::sin(k * X[a]);
    out.velocity_gradient(a, a) = speed * k * std::cos(k * X[a]) / now.stretch;
    out.volume_ratio *= now.stretch;
  }
  return out;
}

template <int Dim>
ExactPoint<Dim> point(const TaylorGreen& flow, const Vec<Dim>&, const Vec<Dim>& x, double t) {
  ExactPoint<Dim> out;
  const double k = flow.wave_number, u = speed_at(flow, t);
  const double sx = std::sin(k * x[0]), cx = std::cos(k * x[0]), sy = std::sin(k * x[1]), cy = std::cos(k * x[1]);
  out.velocity[0] = u * sx * cy;
  out.velocity[1] = -u * cx * sy;
  out.velocity_gradient(0, 0) = u * k * cx * cy;
  out.velocity_gradient(0, 1) = -u * k * sx * sy;
  out.velocity_gradient(1, 0) = u * k * sx * sy;
  out.velocity_gradient(1, 1) = -u * k * cx * cy;
  out.volume_ratio = 1 / (1 + pressure<Dim>(flow, x, t) / flow.bulk_modulus);
  return out;
}

template <int Dim>
ExactPoint<Dim> point(const UniformMotion<Dim>& motion, const Vec<Dim>&, const Vec<Dim>&, double t) {
  ExactPoint<Dim> out;
  out.displacement = t * motion.velocity;
  out.velocity = motion.velocity;
  out.volume_ratio = motion.stretch.prod();
  return out;
}

template <int Dim>
ExactPoint<Dim> point(const BarFirstMode& bar, const Vec<Dim>& X, const Vec<Dim>&, double t) {
  ExactPoint<Dim> out;
  const double k = bar.wave_number, shape = std::sin(k * X[bar.axis]), slope = k * std::cos(k * X[bar.axis]);
  const double swing = bar.amplitude / bar.frequency * std::sin(bar.frequency * t);
  const double speed = bar.amplitude * std::cos(bar.frequency * t);
  out.displacement[bar.axis] = swing * shape;
  out.velocity[bar.axis] = speed * shape;
  out.volume_ratio = 1 + swing * slope;
  out.velocity_gradient(bar.axis, bar.axis) = speed * slope / out.volume_ratio;
  return out;
}

/// (1 - s^2)^2 of s = (R - R0) / w, 0 beyond the ring, with its derivatives by R [1/m], [1/m2].
struct Bump {
  double value = 0, slope = 0, curvature = 0;
};
Bump bump(const GeneralizedVortex& vortex, double R) {
  const double w = vortex.half_width, s = (R - vortex.radius) / w, rest = 1 - s * s;
  if (rest <= 0) return {};
  return {rest * rest, -4 * s * rest / w, (12 * s * s - 4) / (w * w)};
}

/// `e_r` and `e_theta` where the point X is at time t.
template <int Dim>
struct TurnedAxes {
  Vec<Dim> along = Vec<Dim>::Zero(), across = Vec<Dim>::Zero();
};
template <int Dim>
TurnedAxes<Dim> turned_axes(const Vec<Dim>& X, double turn) {
  const double angle = std::atan2(X[1], X[0]) + turn, c = std::cos(angle), s = std::sin(angle);
  TurnedAxes<Dim> axes;
  axes.along[0] = axes.across[1] = c;
  axes.along[1] = s;
  axes.across[0] = -s;
  return axes;
}

template <int Dim>
ExactPoint<Dim> point(const GeneralizedVortex& vortex, const Vec<Dim>& X, const Vec<Dim>&, double t) {
  const double R = std::hypot(X[0], X[1]), swing = vortex.angle * std::sin(vortex.frequency * t);
  const Bump b = bump(vortex, R);
  const TurnedAxes<Dim> axes = turned_axes<Dim>(X, swing * b.value), before = turned_axes<Dim>(X, 0.0);
  const double rate = vortex.angle * vortex.frequency * std::cos(vortex.frequency * t);
  ExactPoint<Dim> out;
  out.displacement = R * (axes.along - before.along);
  out.velocity = R * rate * b.value * axes.across;
  out.velocity_gradient = rate * ((b.value + R * b.slope) * axes.across * axes.along.transpose() -
                                  b.value * axes.along * axes.across.transpose());
  return out;
}

/// a'' of the drop at the stretch a that changes at the speed a', from rho (a'' + B^2 a) a = 2 P = rho (b'' + B^2 b) b
/// with b = 1/a and the pressure P (1 - (x/a)^2 - (y/b)^2) / R^2.
double acceleration(const OscillatingDrop& drop, double a, double speed) {
  const double a2 = a * a, b2 = drop.frequency * drop.frequency;
  return (2 * speed * speed / (a2 * a2) + b2 * (1 / a2 - a2)) / (a + 1 / (a2 * a));
}

template <int Dim>
ExactPoint<Dim> point(const OscillatingDrop& drop, const Vec<Dim>& X, const Vec<Dim>& x, double t) {
  const DropShape now = shape_at(drop, t);
  ExactPoint<Dim> out;
  out.displacement[0] = (now.stretch - 1) * X[0];
  out.displacement[1] = (1 / now.stretch - 1) * X[1];
  out.velocity[0] = now.rate * x[0];
  out.velocity[1] = -now.rate * x[1];
  out.velocity_gradient(0, 0) = now.rate;
  out.velocity_gradient(1, 1) = -now.rate;
  out.volume_ratio = 1 / (1 + pressure<Dim>(drop, x, t) / drop.bulk_modulus);
  return out;
}

/// f of psi = f y at the distance r from the centre of the pair [m/s], g = f'/r [1/(m s)] and h = g'/r [1/(m3 s)].
struct StreamFactor {
  double f, g, h;
};
constexpr double first_zero_of_j1 = 3.8317059702075123;
StreamFactor stream_factor(const LambDipole& pair, double r) {
  const double U = pair.speed, a2 = pair.radius * pair.radius, r2 = r * r;
  if (r >= pair.radius) return {U * a2 / r2, -2 * U * a2 / (r2 * r2), 8 * U * a2 / (r2 * r2 * r2)};
  // (J1/s)' = -J2/s, (J2/s^2)' = -J3/s^2. Below the smallest s all three are constant to 1e-13.
  constexpr double smallest = 1e-6;
  const double k = first_zero_of_j1 / pair.radius, k2 = k * k, s = std::max(k * r, smallest);
  const double c = 2 * U / std::cyl_bessel_j(0.0, first_zero_of_j1);
  return {U - c * std::cyl_bessel_j(1.0, s) / s, c * k2 * std::cyl_bessel_j(2.0, s) / (s * s),
          -c * k2 * k2 * std::cyl_bessel_j(3.0, s) / (s * s * s)};
}

template <int Dim>
ExactPoint<Dim> point(const LambDipole& pair, const Vec<Dim>&, const Vec<Dim>& at, double t) {
  const Vec<Dim> away = at - centre_at<Dim>(pair, t);
  const double x = away[0], y = away[1];
  const auto [f, g, h] = stream_factor(pair, std::hypot(x, y));
  ExactPoint<Dim> out;
  out.velocity[0] = f + y * y * g;
  out.velocity[1] = -x * y * g;
  out.velocity_gradient(0, 0) = x * (g + y * y * h);
  out.velocity_gradient(0, 1) = y * (3 * g + y * y * h);
  out.velocity_gradient(1, 0) = -y * (g + x * x * h);
  out.velocity_gradient(1, 1) = -x * (g + y * y * h);
  out.volume_ratio = 1 / (1 + pressure<Dim>(pair, at, t) / pair.bulk_modulus);
  return out;
}

}  // namespace

DropShape shape_at(const OscillatingDrop& drop, double t) {
  constexpr double largest_angle = 0.02;  // rad a step: 1e-9 of the stretch over a period
  const int steps = static_cast<int>(std::ceil(t * std::max(drop.frequency, std::abs(drop.rate)) / largest_angle));
  double a = 1, speed = drop.rate;
  for (int n = 0; n < steps; ++n) {
    const double dt = t / steps;
    const double k1 = acceleration(drop, a, speed);
    const double v2 = speed + dt / 2 * k1, k2 = acceleration(drop, a + dt / 2 * speed, v2);
    const double v3 = speed + dt / 2 * k2, k3 = acceleration(drop, a + dt / 2 * v2, v3);
    const double v4 = speed + dt * k3, k4 = acceleration(drop, a + dt * v3, v4);
    a += dt / 6 * (speed + 2 * v2 + 2 * v3 + v4);
    speed += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return {a, speed / a};
}

template <int Dim>
ExactSolution<Dim> make_exact(const ExactSpec& spec, const Material& material) {
  return std::visit([&](const auto& s) { return make<Dim>(s, material); }, spec.solution);
}

template <int Dim>
ExactSolution<Dim> exact_solution(const Scene& scene, const std::string& body) {
  const ExactSpec* const spec = find_exact(scene, body);
  const BodySpec* const owner = find_body(scene, body);
  const MaterialSpec* const material = owner ? find_material(scene, owner->material) : nullptr;
  if (spec && material) return make_exact<Dim>(*spec, make_material(*material));
  throw std::logic_error("check_scene let a body without exact solution pass: " + body);
}

template <int Dim>
ExactPoint<Dim> exact_point(const ExactSolution<Dim>& solution, const Vec<Dim>& X, const Vec<Dim>& x, double t) {
  return std::visit([&](const auto& s) { return point<Dim>(s, X, x, t); }, solution);
}

template <int Dim>
double pressure(const TaylorGreen& flow, const Vec<Dim>& x, double t) {
  const double k = flow.wave_number, u = speed_at(flow, t);
  return flow.density * u * u / 4 * (std::cos(2 * k * x[0]) + std::cos(2 * k * x[1]));
}

template <int Dim>
double pressure(const OscillatingDrop& drop, const Vec<Dim>& x, double t) {
  const auto [a, rate] = shape_at(drop, t);
  const double speed = a * rate, R2 = drop.radius * drop.radius;
  const double twice = (acceleration(drop, a, speed) + drop.frequency * drop.frequency * a) * a * R2;
  return drop.density / 2 * twice * std::max(0.0, 1 - (x[0] * x[0] / (a * a) + x[1] * x[1] * a * a) / R2);
}

template <int Dim>
Vec<Dim> centre_at(const LambDipole& pair, double t) {
  Vec<Dim> centre = Vec<Dim>::Zero();
  centre[0] = pair.centre[0] + pair.speed * t;
  centre[1] = pair.centre[1];
  return centre;
}

/// Bernoulli's law beside the pair, for which the flow is steady, psi' = psi - U y: p/rho + u'^2/2 is U^2/2 on the
/// circle and beyond, and within it less by k^2 psi'^2/2, as the vorticity there is k^2 psi'.
template <int Dim>
double pressure(const LambDipole& pair, const Vec<Dim>& x, double t) {
  const Vec<Dim> away = x - centre_at<Dim>(pair, t);
  const double U = pair.speed, y = away[1], r = std::hypot(away[0], y);
  const auto [f, g, h] = stream_factor(pair, r);
  const double along = f + y * y * g - U, across = -away[0] * y * g;
  const double turning = r < pair.radius ? first_zero_of_j1 / pair.radius * (f - U) * y : 0;  // k psi'
  return pair.density / 2 * (U * U - along * along - across * across - turning * turning);
}

/// rho0 (u'' - b) = dP/dX along each axis. With F diagonal P_a = mu (F_a - 1/F_a) + lambda ln J / F_a, of which along
/// axis a only F_a varies, dF_a/dX_a = -k^2 u_a.
template <int Dim>
Vec<Dim> body_force(const AxisAlignedMms& mms, const Vec<Dim>& X, double t) {
  const double k = mms.wave_number, omega = mms.frequency;
  Vec<Dim> u, stretch;
  for (int a = 0; a < Dim; ++a) {
    const AlongAxis now = along_axis(mms, a, X[a], t);
    u[a] = now.displacement;
    stretch[a] = now.stretch;
  }
  const double log_volume = std::log(stretch.prod());
  Vec<Dim> force;
  for (int a = 0; a < Dim; ++a) {
    const double stiffness =
        mms.shear_modulus + (mms.shear_modulus + mms.lame_lambda * (1 - log_volume)) / (stretch[a] * stretch[a]);
    force[a] = u[a] * (k * k * stiffness / mms.density - omega * omega);
  }
  return force;
}

/// b = x'' - div sigma / rho with the shear gamma = R dalpha/dR: sigma_rtheta = mu gamma, sigma_thetatheta = mu
/// gamma^2.
template <int Dim>
Vec<Dim> body_force(const GeneralizedVortex& vortex, const Vec<Dim>& X, double t) {
  const double R = std::hypot(X[0], X[1]), omega = vortex.frequency;
  const Bump b = bump(vortex, R);
  const double swing = vortex.angle * std::sin(omega * t), rate = vortex.angle * omega * std::cos(omega * t) * b.value;
  const TurnedAxes<Dim> axes = turned_axes<Dim>(X, swing * b.value);
  const double slope = swing * b.slope, curvature = swing * b.curvature;
  return (vortex.rigidity * R * slope * slope - R * rate * rate) * axes.along -
         (R * omega * omega * swing * b.value + vortex.rigidity * (3 * slope + R * curvature)) * axes.across;
}

template <int Dim>
Vec<Dim> body_force(const OscillatingDrop& drop, const Vec<Dim>& x, double) {
  return -drop.frequency * drop.frequency * x;
}

template <int Dim>
double velocity_scale(const ExactSolution<Dim>& solution, double t) {
  if (const auto* mms = std::get_if<AxisAlignedMms>(&solution)) return mms->amplitude * mms->frequency;
  if (const auto* bar = std::get_if<BarFirstMode>(&solution)) return std::abs(bar->amplitude);
  if (const auto* motion = std::get_if<UniformMotion<Dim>>(&solution)) return motion->wave_speed;
  if (const auto* vortex = std::get_if<GeneralizedVortex>(&solution))
    return std::abs(vortex->angle) * vortex->frequency * vortex->radius;
  if (const auto* drop = std::get_if<OscillatingDrop>(&solution))
    return drop->radius * std::hypot(drop->rate, drop->frequency);
  if (const auto* pair = std::get_if<LambDipole>(&solution)) return pair->speed;
  return speed_at(std::get<TaylorGreen>(solution), t) / std::numbers::sqrt2;
}

template <int Dim>
double strain_scale(const ExactSolution<Dim>& solution) {
  double strain = 0;
  if (const auto* mms = std::get_if<AxisAlignedMms>(&solution)) strain = mms->amplitude * mms->wave_number;
  if (const auto* bar = std::get_if<BarFirstMode>(&solution))
    strain = std::abs(bar->amplitude) * bar->wave_number / bar->frequency;
  if (const auto* motion = std::get_if<UniformMotion<Dim>>(&solution))
    strain = (motion->stretch.array() - 1).abs().maxCoeff();
  return strain > 0 ? strain : 1;
}

#define GEODROP_INSTANTIATE(D)                                                                          \
  template ExactSolution<D> make_exact<D>(const ExactSpec&, const Material&);                           \
  template ExactSolution<D> exact_solution<D>(const Scene&, const std::string&);                        \
  template ExactPoint<D> exact_point<D>(const ExactSolution<D>&, const Vec<D>&, const Vec<D>&, double); \
  template double pressure<D>(const TaylorGreen&, const Vec<D>&, double);                               \
  template double pressure<D>(const OscillatingDrop&, const Vec<D>&, double);                           \
  template Vec<D> centre_at<D>(const LambDipole&, double);                                              \
  template double pressure<D>(const LambDipole&, const Vec<D>&, double);                                \
  template Vec<D> body_force<D>(const AxisAlignedMms&, const Vec<D>&, double);                          \
  template Vec<D> body_force<D>(const GeneralizedVortex&, const Vec<D>&, double);                       \
  template Vec<D> body_force<D>(const OscillatingDrop&, const Vec<D>&, double);                         \
  template double velocity_scale<D>(const ExactSolution<D>&, double);                                   \
  template double strain_scale<D>(const ExactSolution<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
