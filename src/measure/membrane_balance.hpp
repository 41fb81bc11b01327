// Whether a membrane that slides over a soil is in balance along its line.
#pragma once

#include <geodrop/state/state.hpp>

namespace geodrop {

/// Largest change of tension at a node over what friction (mu p'), friction on the bed and loads on the node can give
/// it there [-]: up to 1 in balance, and the slight drag of sliding (membrane/slide_membranes). Nodes where tension
/// changes by less than 1 N per metre of depth do not count. Of the state after a step: the line has moved a little
/// since.
double friction_ratio(const Membrane<2>& membrane, double gravity);

}  // namespace geodrop
