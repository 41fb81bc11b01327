// What bodies start from: velocity, stress, and the exact solutions that they may follow.
#include "sections.hpp"

namespace geodrop {

// clang-format off
SectionOf<InitialVelocity> initial_velocity_section() {
  constexpr RowsOf<InitialVelocity> key;
  return {
      "initial_velocity of a body", "",
      "An inline table; `type` says which keys it has.",
      R"([[bodies]]
name = "bag"
material = "sand"
shape = { type = "ellipse", centre = [0.0, 4.5], semi_axes = [1.0, 0.5] }
initial_velocity = { type = "uniform", value = [0.0, -1.0] }
initial_stress = { type = "fluid_pressure", fluid = "water", surface = 6.0, effective_pressure = 2000.0 })", {
      key("type", itself<InitialVelocity>, {{"rest", UniformVelocitySpec{}}, {"uniform", UniformVelocitySpec{}}, {"bar_first_mode", BarFirstModeSpec{}}, {"linear", LinearVelocitySpec{}}, {"pulse", PulseVelocitySpec{}}, {"exact", FromExactSpec{}}}, required, "which field; linear: v = gradient (x - centre); pulse: v = value cos^2(pi (x - centre) / width) along an axis, at rest beyond half the width; exact: of the solution that the body follows"),
      key("value", Either(&UniformVelocitySpec::value, &PulseVelocitySpec::value), "m/s", required, any, "velocity of all particles; of those in the middle of the pulse").only("type=uniform|pulse"),
      key("amplitude", &BarFirstModeSpec::amplitude, "m/s", required, any, "velocity of the free end: v = amplitude sin(pi x / (2 length))").only("type=bar_first_mode"),
      key("gradient", &LinearVelocitySpec::gradient, "1/s", required, any, "as many rows as dimension, dv_a/dx_b").only("type=linear"),
      key("centre", Either(&LinearVelocitySpec::centre, &PulseVelocitySpec::centre), "m", required, any, "where the velocity is 0; the middle of the pulse").only("type=linear|pulse"),
      key("axis", Either(&BarFirstModeSpec::axis, &PulseVelocitySpec::axis), {{"x", 0}, {"y", 1}}, required, "along the bar; across the pulse").only("type=bar_first_mode|pulse").in(2),
      key("axis", Either(&BarFirstModeSpec::axis, &PulseVelocitySpec::axis), {{"x", 0}, {"y", 1}, {"z", 2}}, required, "along the bar; across the pulse").only("type=bar_first_mode|pulse").in(3),
      key("length", &BarFirstModeSpec::length, "m", required, positive, "of the bar, which is fixed at coordinate 0").only("type=bar_first_mode"),
      key("width", &PulseVelocitySpec::width, "m", required, positive, "of the pulse").only("type=pulse"),
  }};
}

SectionOf<InitialStress> initial_stress_section() {
  constexpr RowsOf<InitialStress> key;
  return {
      "initial_stress of a body", "",
      "An inline table; `type` says which keys it has.",
      R"([[bodies]]
name = "bed"
material = "sand"
shape = { type = "box", lower = [-2.0, -0.5], upper = [2.0, 0.0] }
initial_stress = { type = "k0", surface = 0.0, k0 = 0.5, under = "fluid", fluid = "water", fluid_surface = 6.0 })", {
      key("type", itself<InitialStress>, {{"zero", ZeroStressSpec{}}, {"hydrostatic", HydrostaticSpec{}}, {"k0", K0StressSpec{}}, {"fluid_pressure", FluidPressureSpec{}}, {"uniform", UniformPressureSpec{}}, {"exact", FromExactSpec{}}}, required, "zero: none; hydrostatic: a still fluid; k0: soil at rest; fluid_pressure: the isotropic pressure of a still fluid around, in drained soil as effective stress; uniform: the same pressure everywhere, in a solid as effective stress; exact: of the solution that the body follows"),
      key("pressure", &UniformPressureSpec::pressure, "Pa", required, any, "compression positive").only("type=uniform"),
      key("fluid", Either(&HydrostaticSpec::fluid, [](FluidPressureSpec& around, const std::string& name) { around.fluid.fluid = name; }), required, reference, "the newtonian material of the still fluid").only("type=hydrostatic|fluid_pressure"),
      key("effective_pressure", &FluidPressureSpec::effective_pressure, "Pa", standard("0.0"), not_negative, "p' of the skeleton beside the pressure of the fluid, the same everywhere: what cloth under tension gives a soil inside").only("type=fluid_pressure"),
      key("surface", Either(&HydrostaticSpec::surface, [](FluidPressureSpec& around, double level) { around.fluid.surface = level; }), "m", required, any, "level of the fluid's free surface").only("type=hydrostatic|fluid_pressure"),
      key("surface", &K0StressSpec::surface, "m", required, any, "level of the soil's surface").only("type=k0"),
      key("k0", &K0StressSpec::k0, "", required, not_negative, "horizontal over vertical effective stress").only("type=k0"),
      key("under", &K0StressSpec::fluid, {{"air", std::nullopt}, {"fluid", HydrostaticSpec{}}}, required, "what lies on the soil").only("type=k0"),
      key("fluid", [](K0StressSpec& soil, const std::string& name) { soil.fluid->fluid = name; }, required, reference, "the newtonian material over the soil and in its pores").only("under=fluid"),
      key("fluid_surface", [](K0StressSpec& soil, double level) { soil.fluid->surface = level; }, "m", required, any, "level of the fluid's free surface").only("under=fluid"),
  }};
}

SectionOf<ExactSpec> exact_section() {
  constexpr RowsOf<ExactSpec, &ExactSpec::solution> key;
  return {
      "[[exact]]", "body",
      "Exact solutions that bodies follow; the formulas stand in include/geodrop/solutions/exact.hpp. `axis_aligned_mms`, "
      "`generalized_vortex` and `oscillating_drop` come with the body force that they need.",
      R"([[exact]]
body = "water"
type = "taylor_green"
speed = 0.5
length = 2.0)", {
      key("body", &ExactSpec::body, required, reference, "the body that follows the solution"),
      key("type", &ExactSpec::solution, {{"axis_aligned_mms", AxisAlignedMmsSpec{}}, {"taylor_green", TaylorGreenSpec{}}, {"uniform_motion", UniformMotionSpec{}}, {"bar_first_mode", BarFirstModeSpec{}}, {"generalized_vortex", GeneralizedVortexSpec{}}, {"oscillating_drop", OscillatingDropSpec{}}, {"lamb_dipole", LambDipoleSpec{}}}, required, "axis_aligned_mms: a neo-Hookean block that swings along each axis; generalized_vortex: a neo-Hookean one with a ring that turns to and fro; taylor_green: decaying vortices of water; oscillating_drop: a round drop of water about the origin that a central force draws together (2D); lamb_dipole: a pair of vortices of water without viscosity that moves along x, where there are no walls (2D); uniform_motion: a stretched solid that drifts unchanged; bar_first_mode: a linear elastic bar, fixed at coordinate 0"),
      key("amplitude", &AxisAlignedMmsSpec::amplitude, "m", required, positive, "A of u = A sin(2 pi X / length); 2 pi A / length is below 1").only("type=axis_aligned_mms"),
      key("amplitude", &BarFirstModeSpec::amplitude, "m/s", required, not_zero, "velocity of the free end").only("type=bar_first_mode"),
      key("speed", Either(&TaylorGreenSpec::speed, &LambDipoleSpec::speed), "m/s", required, positive, "U of u = U sin(2 pi x / length) cos(2 pi y / length); at which the pair moves").only("type=taylor_green|lamb_dipole"),
      key("length", Either(&AxisAlignedMmsSpec::length, &TaylorGreenSpec::length, &BarFirstModeSpec::length), "m", required, positive, "of a wave; of the bar").only("type=axis_aligned_mms|taylor_green|bar_first_mode"),
      key("angle", &GeneralizedVortexSpec::angle, "rad", required, positive, "G, by which the ring turns at most: alpha = G sin(frequency t) (1 - s^2)^2, s = (R - radius) / half_width, about the origin").only("type=generalized_vortex"),
      key("radius", Either(&GeneralizedVortexSpec::radius, &OscillatingDropSpec::radius, &LambDipoleSpec::radius), "m", required, positive, "of the circle that turns most; of the drop; of the circle that the pair fills").only("type=generalized_vortex|oscillating_drop|lamb_dipole"),
      key("centre", &LambDipoleSpec::centre, "m", required, any, "of the pair at the start").only("type=lamb_dipole"),
      key("half_width", &GeneralizedVortexSpec::half_width, "m", required, positive, "of the ring; less than radius").only("type=generalized_vortex"),
      key("frequency", Either(&GeneralizedVortexSpec::frequency, &OscillatingDropSpec::frequency), "rad/s", required, positive, "angular frequency of the swing; B of the force -B^2 x per mass").only("type=generalized_vortex|oscillating_drop"),
      key("rate", &OscillatingDropSpec::rate, "1/s", required, not_zero, "A0 of the velocity A0 (x, -y) at the start").only("type=oscillating_drop"),
      key("axis", &BarFirstModeSpec::axis, {{"x", 0}, {"y", 1}}, required, "along the bar").only("type=bar_first_mode").in(2),
      key("axis", &BarFirstModeSpec::axis, {{"x", 0}, {"y", 1}, {"z", 2}}, required, "along the bar").only("type=bar_first_mode").in(3),
      key("velocity", &UniformMotionSpec::velocity, "m/s", required, any, "of the drift").only("type=uniform_motion"),
      key("stretch", &UniformMotionSpec::stretch, "", required, positive, "present over unstrained length along each axis; the body's shape, a box, is the stretched one, and the lattice of its particles is stretched with it").only("type=uniform_motion"),
  }};
}
// clang-format on

}  // namespace geodrop
