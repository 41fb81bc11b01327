// What bodies start from: stress, velocity, and the exact solutions that they may follow.
#pragma once

#include <geodrop/base/error.hpp>
#include <geodrop/geometry/shape.hpp>

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace geodrop {

/// Still fluid below `surface`; p = K (exp(rho0 g d / K) - 1) at depth d, the exact weakly compressible column.
struct HydrostaticSpec {
  std::string fluid;   ///< material name of a Newtonian fluid
  double surface = 0;  ///< level of the free surface [m]
  bool operator==(const HydrostaticSpec&) const = default;
};
/// Zero stress at the start.
struct ZeroStressSpec {
  bool operator==(const ZeroStressSpec&) const = default;
};
/// Soil at rest below its own level surface, under a fluid if `fluid` is given.
struct K0StressSpec {
  double surface = 0;                    ///< level of the soil surface [m]
  double k0 = 0;                         ///< horizontal over vertical effective stress [-]
  std::optional<HydrostaticSpec> fluid;  ///< gives overburden and pore pressure
  bool operator==(const K0StressSpec&) const = default;
};
/// Isotropic total stress equal to the pressure p of the still fluid (a drained bag: effective stress -p I; undrained:
/// pore pressure p), and an isotropic effective stress beside it.
struct FluidPressureSpec {
  HydrostaticSpec fluid;
  double effective_pressure = 0;  ///< [Pa]
  bool operator==(const FluidPressureSpec&) const = default;
};
/// The same pressure everywhere: of a fluid; in a solid effective stress -p I.
struct UniformPressureSpec {
  double pressure = 0;  ///< compression positive [Pa]
  bool operator==(const UniformPressureSpec&) const = default;
};
/// Velocity or stress of the exact solution that the body follows, see ExactSpec.
struct FromExactSpec {
  bool operator==(const FromExactSpec&) const = default;
};
using InitialStress =
    std::variant<ZeroStressSpec, HydrostaticSpec, K0StressSpec, FluidPressureSpec, FromExactSpec, UniformPressureSpec>;

/// The same velocity everywhere (also what `type = "rest"` becomes).
struct UniformVelocitySpec {
  Point value;  ///< [m/s]
  bool operator==(const UniformVelocitySpec&) const = default;
};
/// First mode of a bar fixed at coordinate 0 and free at `length`: v = amplitude sin(pi x / (2 length)) along `axis`.
struct BarFirstModeSpec {
  double amplitude = 0;  ///< velocity of the free end [m/s]
  int axis = 0;          ///< 0: x, 1: y, 2: z
  double length = 0;     ///< [m]
  bool operator==(const BarFirstModeSpec&) const = default;
};
/// v = gradient (x - centre): a rotation, a stretching, a shear.
struct LinearVelocitySpec {
  std::vector<Point> gradient;  ///< rows, dv_a/dx_b [1/s]
  Point centre;                 ///< where it is at rest [m]
  bool operator==(const LinearVelocitySpec&) const = default;
};
/// v = value cos^2(pi (x_a - centre_a) / width) within half the width of the centre along `axis` a, at rest beyond: a
/// pulse that a string or a bar carries away to both sides.
struct PulseVelocitySpec {
  Point value;       ///< in the middle [m/s]
  int axis = 0;      ///< 0: x, 1: y, 2: z
  Point centre;      ///< [m]
  double width = 0;  ///< [m]
  bool operator==(const PulseVelocitySpec&) const = default;
};
using InitialVelocity =
    std::variant<UniformVelocitySpec, BarFirstModeSpec, LinearVelocitySpec, PulseVelocitySpec, FromExactSpec>;

// Exact solutions. What each means stands in exact.hpp.
struct AxisAlignedMmsSpec {
  double amplitude = 0;  ///< A [m]
  double length = 0;     ///< of a wave [m]
  bool operator==(const AxisAlignedMmsSpec&) const = default;
};
struct TaylorGreenSpec {
  double speed = 0;   ///< U [m/s]
  double length = 0;  ///< of a wave, two vortices [m]
  bool operator==(const TaylorGreenSpec&) const = default;
};
struct UniformMotionSpec {
  Point velocity;  ///< [m/s]
  Point stretch;   ///< present over unstrained length [-]
  bool operator==(const UniformMotionSpec&) const = default;
};
struct GeneralizedVortexSpec {
  double angle = 0;       ///< G, largest turn [rad]
  double radius = 0;      ///< of the circle that turns most, about the origin [m]
  double half_width = 0;  ///< of the ring that turns [m]
  double frequency = 0;   ///< omega of sin(omega t) [rad/s]
  bool operator==(const GeneralizedVortexSpec&) const = default;
};
struct OscillatingDropSpec {
  double rate = 0;       ///< A0 of v = A0 (x, -y) at the start [1/s]
  double frequency = 0;  ///< B of the force -B^2 x per mass [rad/s]
  double radius = 0;     ///< of the drop, about the origin [m]
  bool operator==(const OscillatingDropSpec&) const = default;
};
struct LambDipoleSpec {
  double speed = 0;   ///< U, of the pair along x [m/s]
  double radius = 0;  ///< a, of the circle that the vortices fill [m]
  Point centre;       ///< of that circle at the start [m]
  bool operator==(const LambDipoleSpec&) const = default;
};
/// A solution that a body follows: what it may start from, is driven by, and can be compared with.
struct ExactSpec {
  std::string body;
  std::variant<AxisAlignedMmsSpec, TaylorGreenSpec, UniformMotionSpec, BarFirstModeSpec, GeneralizedVortexSpec,
               OscillatingDropSpec, LambDipoleSpec>
      solution;
  SourceRef at;
  bool operator==(const ExactSpec&) const = default;
};

}  // namespace geodrop
