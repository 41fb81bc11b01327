// From the run-time transfer to the compiled kernel: one switch per range, none per particle.
#pragma once

#include "kernels.hpp"
#include "remap.hpp"

namespace geodrop {

template <int Dim, class Basis>
void scatter_dispatch(const Body<Dim>& body, Grid<Dim>& grid, double dt, std::size_t begin, std::size_t end) {
  if (grid.force.empty())
    scatter_range<Dim, Basis, false>(body, grid, dt, begin, end);
  else
    scatter_range<Dim, Basis, true>(body, grid, dt, begin, end);
}

template <int Dim, class Basis>
Maxima gather_dispatch(Body<Dim>& body, const Grid<Dim>& grid, const GatherOptions& options, std::size_t begin,
                       std::size_t end) {
  if constexpr (has_affine<Basis>) {
    if (options.transfer == Transfer::tpic)
      return gather_range<Dim, Basis, Transfer::tpic>(body, grid, options, begin, end);
    if (options.transfer == Transfer::blend)
      return gather_range<Dim, Basis, Transfer::blend>(body, grid, options, begin, end);
  }
  return gather_range<Dim, Basis, Transfer::musl>(body, grid, options, begin, end);
}

}  // namespace geodrop
