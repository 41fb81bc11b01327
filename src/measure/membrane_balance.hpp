// Whether a membrane is in balance: along its line, if it slides over a soil, and across it.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <vector>

namespace geodrop {

/// Largest change of tension at a node over what friction (mu p'), the shear from around and loads on the node can give
/// it there [-]: up to 1 in balance, and the slight drag of sliding (membrane/slide_membranes). Nodes where tension
/// changes by less than 1 N per metre of depth do not count. Of the state after a step: the line has moved a little
/// since.
double friction_ratio(const Membrane<2>& membrane, double gravity);

/// T kappa of a membrane (in space the forces of the triangles across their mean normal, per area) and what presses on
/// it from inside less from around, means over a gauge length or two cells, whichever is longer, in space over a
/// surface that wide [Pa]. In balance they are the same but for the inertia of the cloth.
struct AcrossLine {
  double curvature = 0;  ///< T kappa, pulls inwards
  double pressure = 0;   ///< pushes outwards: stresses of what is beside it in the grid, loads, its own weight
  double error = 0;      ///< of the one against the other, over the larger; NaN where there is no tension [-]
};

/// At each node. Pressure of particles is brought to the membrane with their weight.
template <int Dim>
std::vector<AcrossLine> balance_across(const Scene& scene, const State<Dim>& state, const Membrane<Dim>& membrane);

/// Column of history.csv with the error at the gauge, after the name of the membrane.
inline constexpr const char* balance_column = ".balance_error_ratio";

/// Around the middle of the gauge that has the largest tension now.
template <int Dim>
AcrossLine balance_at_gauge(const Scene& scene, const State<Dim>& state, const Membrane<Dim>& membrane);

}  // namespace geodrop
