// From run-time material and transfer to the compiled kernel: one switch per range, none per particle.
#pragma once

#include "cell_sums.hpp"
#include "kernels.hpp"
#include "scatter.hpp"
#include "simplex.hpp"

namespace geodrop {

/// Calls f(law) with the body's concrete law. A chain of get_if because std::visit does not inline into clones.
template <class F>
auto with_law(const Material& material, F&& f) {
  if (const auto* water = std::get_if<Newtonian>(&material)) return f(*water);
  if (const auto* solid = std::get_if<LinearElastic>(&material)) return f(*solid);
  if (const auto* rubber = std::get_if<NeoHookean>(&material)) return f(*rubber);
  return f(*std::get_if<MohrCoulomb>(&material));
}

template <int Dim, class Basis>
void scatter_dispatch(const Body<Dim>& body, Grid<Dim>& grid, double dt, std::size_t begin, std::size_t end) {
  with_law(body.material, [&](const auto& law) {
    if (grid.force.empty())
      scatter_range<Dim, Basis, false>(body, law, grid, dt, begin, end);
    else
      scatter_range<Dim, Basis, true>(body, law, grid, dt, begin, end);
  });
}

template <int Dim, class Basis>
Maxima gather_dispatch(Body<Dim>& body, const Grid<Dim>& grid, const GatherOptions& options, std::size_t begin,
                       std::size_t end) {
  return with_law(body.material, [&](const auto& law) {
    if (grid.velocity_change.empty()) return gather_range<Dim, Basis, false>(body, law, grid, options, begin, end);
    return gather_range<Dim, Basis, true>(body, law, grid, options, begin, end);
  });
}

template <int Dim>
void sum_cells_dispatch(const Body<Dim>& body, Grid<Dim>& grid, std::size_t begin, std::size_t end) {
  with_law(body.material, [&](const auto& law) { sum_cells_range(body, law, grid, begin, end); });
}

template <int Dim>
void sum_nodal_pressure_dispatch(const Body<Dim>& body, Grid<Dim>& grid, std::size_t begin, std::size_t end) {
  with_law(body.material, [&](const auto& law) { sum_nodal_pressure_range(body, law, grid, begin, end); });
}

}  // namespace geodrop
