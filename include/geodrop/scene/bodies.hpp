// Bodies and the membranes around them.
#pragma once

#include <geodrop/base/error.hpp>
#include <geodrop/geometry/shape.hpp>
#include <geodrop/geometry/triangle_surface.hpp>
#include <geodrop/scene/initial.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace geodrop {

/// Where the mean stress of a body acts from: the cell average (cures locking and noise), each particle, or the nodal
/// average of tri3 and tet4 (the paper's cure), or cells cut exactly by the membrane around (cut/enclosed_fluid).
enum class PressureSupport { cell, particle, nodal, enclosed };

struct BodySpec {
  std::string name;
  std::string material;
  Shape shape;
  std::vector<std::string> minus;   ///< bodies whose shapes are cut out of this one
  std::string saturated_by;         ///< body of a fluid that fills the pores of a coupled soil; empty: none
  int particles_per_cell_axis = 2;  ///< particles per cell and axis [-]
  double jitter = 0;                ///< random offset, fraction of the particle spacing [-]
  std::uint64_t jitter_seed = 0;
  InitialVelocity initial_velocity;
  InitialStress initial_stress;
  PressureSupport pressure = PressureSupport::cell;
  bool implicit_pore_pressure = false;  ///< of undrained soil, see grid/implicit_pressure
  int layers = 1;                       ///< horizontal bands that colour the picture
  double shift_speed = 0;               ///< v0 of particle shifting [m/s]
  bool shift = false;                   ///< particle shifting (fluids only)
  SourceRef at;
  bool operator==(const BodySpec&) const = default;
};

/// How the body of a membrane and what is around it share cells.
enum class Interface {
  mixture,  ///< one velocity field: they stick to each other
  sharp     ///< a field each, cut cells between them; they slip along the membrane (src/cut)
};
/// What hinders the fluid around that slips along a sharp interface.
enum class Shear {
  none,        ///< nothing
  wall_law,    ///< tau = 1/2 rho C_f |u| u, u the velocity of slipping
  rough_wall,  ///< the same, C_f from the logarithmic law of a rough wall
  no_slip      ///< it sticks
};
/// Surfaces of membranes in space.
struct EllipsoidSurface {
  Point centre, semi_axes;  ///< [m]
  bool operator==(const EllipsoidSurface&) const = default;
};
/// A cylinder with hemispherical caps.
struct CapsuleSurface {
  Point from, to;     ///< centres of the caps [m]
  double radius = 0;  ///< [m]
  bool operator==(const CapsuleSurface&) const = default;
};
/// Two flat rectangles of cloth sewn together along their rims.
struct PillowSurface {
  Point centre;                  ///< [m]
  double length = 0, width = 0;  ///< of the cloth along x and y [m]
  double thickness = 0;          ///< in the middle, as drawn [m]
  bool operator==(const PillowSurface&) const = default;
};
/// Two flat discs of cloth sewn together along their rims.
struct DiscPillowSurface {
  Point centre;          ///< [m]
  double radius = 0;     ///< of the cloth [m]
  double thickness = 0;  ///< in the middle, as drawn [m]
  bool operator==(const DiscPillowSurface&) const = default;
};
/// A straight tube with flat ends.
struct TubeSurface {
  enum class Section { ellipse, stadium } section = Section::ellipse;
  Point from, to;                          ///< middles of its ends [m]
  double half_width = 0, half_height = 0;  ///< of its section, before that is tilted [m]
  double tilt_deg = 0;                     ///< of the section, anticlockwise as seen from `to` [degree]
  bool operator==(const TubeSurface&) const = default;
};
struct FileSurface {
  std::string file;  ///< .stl or .obj
  bool operator==(const FileSurface&) const = default;
};
/// The first of them: a line in the plane.
using SurfaceSpec = std::variant<std::monostate, EllipsoidSurface, CapsuleSurface, TubeSurface, PillowSurface,
                                 DiscPillowSurface, FileSurface>;

/// What a membrane in space is made of.
enum class Fabric {
  isotropic,  ///< a tension field: taut, wrinkled or slack
  yarns,      ///< two families of yarns, warp and weft
  rubber      ///< a tension field of an incompressible neo-Hookean sheet
};

/// Follows from the surface of a membrane; equal as those are.
struct DrawnSurface {
  std::shared_ptr<const SurfaceRegion> region;   ///< what is inside, closed at its ends
  std::shared_ptr<const TriangleSurface> cloth;  ///< open there
  std::vector<SurfaceEnd> ends;
  bool operator==(const DrawnSurface&) const { return true; }
};

struct MembraneSpec {
  std::string name;
  std::string body;           ///< lies on this body's outline
  std::vector<Point> points;  ///< polyline [m]; empty: the whole outline, closed
  bool closed = true;
  double axial_stiffness = 0;     ///< J [N/m]
  double mass_per_area = 0;       ///< [kg/m2]
  double strength = 0;            ///< [N/m]
  double slack = 0;               ///< rest length / drawn length - 1 [-]
  double segments_per_cell = 4;   ///< spacing of nodes = h of the finest cells / segments_per_cell
  double contents_friction = -1;  ///< mu between it and its body [-]; infinite: glued; < 0: as the body's material says
  double gauge_length = 0.2;      ///< of the reported tension [m]
  Interface interface = Interface::mixture;
  Shear shear = Shear::none;
  double wall_friction = 0;     ///< C_f of Shear::wall_law [-]
  double roughness = 0;         ///< k_s of Shear::rough_wall [m]
  double drag_coefficient = 0;  ///< C_d of a drag that the fluid does not feel, on the width across the motion [-]
  std::string bed;              ///< body around that a sharp membrane rubs on; empty: none
  double bed_friction = 0;      ///< on it [-]
  double permittivity = 0;      ///< psi: flow per area and head [1/s]; 0: tight
  double clogging = 0;          ///< part of it that clogged pores take [-]
  std::vector<double> permittivity_strains;  ///< at which it is that many times psi, linear between [-]; empty: once
  std::vector<double> permittivity_factors;  ///< likewise [-]
  SurfaceSpec surface;                       ///< in space
  std::vector<std::string> ends_at;          ///< in space: walls at which the surface ends
  DrawnSurface drawn;                        ///< in space, once it is drawn
  Fabric fabric = Fabric::isotropic;
  double poisson_ratio = 0;   ///< of an isotropic one [-]
  double weft_stiffness = 0;  ///< of one of yarns [N/m]; axial_stiffness is that of the warp
  double weft_strength = 0;   ///< likewise [N/m]
  Point warp;                 ///< direction of the warp, or what of it lies in the cloth [-]
  double gauge_pressure = 0;  ///< inside over outside, the same all over [Pa]
  SourceRef at;
  bool operator==(const MembraneSpec&) const = default;
};

}  // namespace geodrop
