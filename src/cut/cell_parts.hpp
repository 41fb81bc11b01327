// What a sharp membrane makes of the cells that it cuts.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <array>
#include <vector>

namespace geodrop {

/// Renews the outline of a membrane.
void cut(const GridLayout<2>& layout, const Membrane<2>& membrane, CutCells& cells);
void cut(const GridLayout<3>& layout, const Membrane<3>& membrane, ClippedSurface& cells);

/// Of a cut cell: a_ic with walls folded in, int N over the part inside and its images beyond walls, the sum of outward
/// normals [m, m2].
template <int Dim>
struct CutCell {
  int flat;
  Slope<Dim> inside{};
  SplineVolumes<Dim> value{};
  std::array<double, Dim> normal{};
};

/// The cells that the membrane of a field cuts.
std::vector<CutCell<2>> cut_cells_of(const Grid<2>& grid, const Membrane<2>& membrane);
std::vector<CutCell<3>> cut_cells_of(const Grid<3>& grid, const Membrane<3>& membrane);

}  // namespace geodrop
