// What lies at the stretches of sharp membranes, and the tractions on their segments or triangles.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <algorithm>
#include <limits>
#include <vector>

#include "cloth_knots.hpp"
#include "interface_rows.hpp"
#include "rough_wall.hpp"

namespace geodrop {

/// A stretch of a membrane and what lies there.
template <int Dim>
struct Contact {
  Membrane<Dim>* membrane;
  Stretch stretch;
  const ClothKnots* knots = nullptr;  ///< of the membrane, in space
  bool on_bed = false;
  bool in_air = false;       ///< dry, nothing touches it, and the membrane lets water out of the pores inside
  bool lets_air_in = false;  ///< in air, and the water inside does not press on it
  double pore_pressure = 0;  ///< of the bed [Pa]
  bool on_grains = false;    ///< on a bed of coupled soil, whose grains have a velocity field of their own
  double gap = 0;            ///< between it and that one [m]
  double of_grains = 0;      ///< their pressure on it [Pa]
  double inside = 0;         ///< effective pressure of the soil inside on a membrane that slides over it [Pa]
  double permeance = 0;      ///< of the membrane at its strain there, where water or air is around [m/(s Pa)]
  bool joined = false;       ///< both sides have mass there
  bool has_rows = false;     ///< it is joined, or holds the water in the pores inside
  double pressure = 0;       ///< [Pa]
  double velocity = -1;      ///< of slipping, at a distance from the membrane [m/s]; < 0: not known there
  double distance = 0;       ///< that one [m]
  /// Of a stretch that may rub in space: its mean normal, longer than 1 as its area is larger than its projection, and
  /// two unit vectors along it.
  std::array<std::array<double, Dim>, Dim == 3 ? 3 : 0> axes{};

  bool over_soil() const { return !membrane->contents_pressure.empty(); }
  bool lies() const { return on_bed || on_grains; }
  bool sticks() const { return !lies() && membrane->shear == Shear::no_slip && !over_soil(); }
  bool rubs() const { return lies() || (membrane->shear != Shear::none && !sticks()); }

  /// Largest traction along it [Pa]: what is around can give; of bodies that stick or rub by Coulomb also no more than
  /// the soil inside can take, as the weaker one of the two slips. slip [m2/s, m3/s]: the velocity of slipping times
  /// length or area.
  double most_friction(double slip) const {
    const double taken = over_soil() ? membrane->contents_friction * inside : std::numeric_limits<double>::infinity();
    const double on_soil = on_grains ? of_grains : pressure - pore_pressure;
    if (lies()) return std::min(taken, std::max(0.0, membrane->bed_friction * on_soil));
    if (membrane->shear == Shear::no_slip) return taken;
    const bool far = membrane->shear == Shear::rough_wall && velocity >= 0;
    const double u = far ? velocity : slip / stretch.size;
    const double friction = membrane->shear == Shear::rough_wall ? rough_wall_friction(distance, membrane->roughness)
                                                                 : membrane->wall_friction;
    return 0.5 * membrane->fluid_density * friction * u * u;
  }
};

/// int N n dl, int N n dA over the stretch of a contact.
inline std::vector<NodeVector<2>> normals_of(const GridLayout<2>& layout, const CutCells& cells,
                                             const Contact<2>& contact) {
  return normals_over(layout, *contact.membrane, cells, contact.stretch);
}
inline std::vector<NodeVector<3>> normals_of(const GridLayout<3>& layout, const ClippedSurface& cells,
                                             const Contact<3>& contact) {
  return normals_over(layout, cells, contact.stretch);
}

/// What a row says: the normal velocities inside and around are one, or those along the membrane, in space by two rows;
/// or, of the water in pores, what flows through the membrane relative to the grains; or the grains of a coupled bed do
/// not go through.
enum class Says { normal, tangent, second_tangent, through, grains };

/// Adds a share of a row's traction to that of a segment or triangle.
void add_traction(const Contact<2>& contact, const CutCells& cells, Says says, std::size_t segment, double traction);
void add_traction(const Contact<3>& contact, const ClippedSurface& cells, Says says, std::size_t triangle,
                  double traction);

/// Mean over a stretch of the traction that its segments or triangles had.
template <int Dim>
double last_traction(const Contact<Dim>& contact, const Outline<Dim>& cells, Says says);

template <int Dim>
void forget_tractions(Membrane<Dim>& membrane);

/// Permeance of a segment or triangle at its strain, Membrane::permeance times the factor of its table [m/(s Pa)].
template <int Dim>
double permeance_of(const Membrane<Dim>& membrane, std::size_t segment);

/// The stretches of all sharp membranes. Soil that a membrane slides over is for the plane.
template <int Dim>
std::vector<Contact<Dim>> find_contacts(State<Dim>& state, const Grids<Dim>& grids);

}  // namespace geodrop
