// The drag of a wake that a flow without friction lacks, as an engineer puts it: F = 1/2 rho C_d W |v| v, W the width
// of the body across its motion. It acts on the parts of the membrane that face the motion and are wet, as the traction
//
//   t = -1/2 rho C_d (n . v)+ v
//
// whose sum over a convex outline is -F. The fluid does not feel it: what a wake would carry off is not in the fluid.
#pragma once

#include <geodrop/state/state.hpp>

namespace geodrop {

/// Adds it to the loads of sharp membranes with a drag coefficient [N], v the mean velocity of their body.
void add_model_drag(State<2>& state);

}  // namespace geodrop
