// How the tractions across sharp membranes vary: the space in which join_interfaces looks for them.
//
// A pressure of its own for each stretch, about a cell long, asks more of the velocities beside a membrane than the
// nodes there can give: water that slipped past a curved one lost a fifth of its energy, and pressures alternated from
// cell to cell (docs/dumping.md). So in the plane the pressure is linear between knots about two cells apart, and a
// stretch has the mean over it: the traction of row r is sum_k B_rk x_k, x_k that at knot k. Constant pressures and,
// along straight lines, those of still water are among them. A run of stretches that are all on the bed or all not, and
// follow each other, has knots at its ends, where the outline turns, and evenly between these. In space knots are nodes
// of the cloth (cloth_knots); stretches on the bed, and grains on a stretch, have a pressure each.
#pragma once

#include <geodrop/grid/grid.hpp>

#include <cstddef>
#include <vector>

#include "interface_contacts.hpp"
#include "node_rows.hpp"

namespace geodrop {

/// Distance of knots, in cells.
inline constexpr double between_knots = 2;

/// What a row of the constraint is about.
struct RowOfContact {
  std::size_t contact;
  Says says;
};

/// B, for the rows of contacts and then `others` rows of something else, whose tractions are their own as those along
/// the membrane are. Every row of B adds up to one.
SparseRows traction_basis(const std::vector<Contact<2>>& contacts, const Grids<2>& grids,
                          const std::vector<RowOfContact>& rows, std::size_t others);
SparseRows traction_basis(const std::vector<Contact<3>>& contacts, const Grids<3>& grids,
                          const std::vector<RowOfContact>& rows, std::size_t others);

}  // namespace geodrop
