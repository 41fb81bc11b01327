// Pore pressure of undrained soil, found at the end of the step (implicit Euler): the time step follows the skeleton,
// not the water in its pores, which may be as stiff as it is.
//
//   dp_c = -dt K_c D_c(v'),   v'_i = v_i + (dt / m_i) sum_c g_ic dp_c,   D_c = (1 / V_c) sum_i g_ic . v'_i
//
// K_c: mean of K_f / n over the cell's volume; g_ic = int_c grad N_i as in grid/cell_pressure, softened as there. Only
// the velocities change here: the particles' pore pressures follow from the volume rates as without it. The system
// (V_c / (K_c dt^2) + g M^-1 g^T) q = -g . v for q = dt dp is symmetric and positive definite, whatever the masses of
// nodes: those of small mass take all of their impulse here. Conjugate gradients.
// What the cells move may be two fields in one place, grains and the water in their pores: a Medium then tells what
// impulses make of their velocities.
// Parts of cells beside a sharp interface that share a pressure are one row. There nodes of small mass hand on what
// they cannot take, as their volume rates see it (carried_velocity). After join_interfaces: the velocities that this
// leaves are those of the volume rates, so that at rest the stored pore pressure is the one that acts. As the
// semi-implicit treatment of pressure by Chorin (1968), with compressibility.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include "node_vectors.hpp"

namespace geodrop {

/// What pressures move where that is not the field of their grid alone. Vectors of nodes are fields of the whole grid.
template <int Dim>
class Medium {
 public:
  virtual ~Medium() = default;
  /// Where impulses will be, by node.
  virtual void begin(const std::vector<bool>& pressed) = 0;
  /// About what an impulse makes of the velocity there, for the preconditioner [1/kg]; 0: no mass.
  virtual double lightness(int node) const = 0;
  /// From impulses at nodes [N s] to the velocities that cells see [m/s]; symmetric and positive.
  virtual void respond(NodeVectors<Dim>& impulse) = 0;
  /// The velocities that cells see [m/s].
  virtual void velocities(NodeVectors<Dim>& out) const = 0;
  /// Adds what the last impulses did to the nodal velocities.
  virtual void move() = 0;
};

/// Adds what the change of pore pressure does to the nodal velocities; throws RunError if it is not found.
template <int Dim>
void press_cells(Grid<Dim>& grid, double dt, Medium<Dim>* medium = nullptr);

/// The same, unless the last step found that this one has to be explicit (BodySettings::implicit_pores); renews that.
/// Particles in cells that carry no pressure act by themselves, with all of their stiffness.
template <int Dim>
void press_pores(State<Dim>& state, Grid<Dim>& grid, double dt, Medium<Dim>* medium = nullptr);

}  // namespace geodrop
