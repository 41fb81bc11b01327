// From the run-time transfer to the compiled kernel: one switch per range, none per particle.
//
// Each (dimension, basis) is compiled in a translation unit of its own: GEODROP_KERNELS(dimension, basis policy), and
// for simplices GEODROP_NODAL_KERNELS(dimension).
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

// Macros, because clones for several processors are made of functions with a body of their own (explicit
// specialisations), not of templates.
#define GEODROP_KERNELS(D, B)                                                                                    \
  template <>                                                                                                    \
  GEODROP_KERNEL void scatter<D, B>(const Body<D>& body, Grid<D>& grid, double dt, std::size_t begin,            \
                                    std::size_t end) {                                                           \
    scatter_dispatch<D, B>(body, grid, dt, begin, end);                                                          \
  }                                                                                                              \
  template <>                                                                                                    \
  GEODROP_KERNEL Maxima gather<D, B>(Body<D> & body, const Grid<D>& grid, const GatherOptions& options,          \
                                     std::size_t begin, std::size_t end) {                                       \
    return gather_dispatch<D, B>(body, grid, options, begin, end);                                               \
  }                                                                                                              \
  template <>                                                                                                    \
  GEODROP_KERNEL void update_velocity<D, B>(Body<D> & body, const Grid<D>& grid, const GatherOptions& options,   \
                                            std::size_t begin, std::size_t end) {                                \
    update_velocity_range<D, B>(body, grid, options, begin, end);                                                \
  }                                                                                                              \
  template <>                                                                                                    \
  GEODROP_KERNEL void sum_by_mass<D, B>(const Body<D>& body, const ByMass<D>& what, const GridLayout<D>& layout, \
                                        Vec4* sum, std::size_t begin, std::size_t end) {                         \
    sum_by_mass_range<D, B>(body, what, layout, sum, begin, end);                                                \
  }

#define GEODROP_NODAL_KERNELS(D)                                                                                      \
  template <>                                                                                                         \
  GEODROP_KERNEL void sum_nodal_pressure<D>(const Body<D>& body, Grid<D>& grid, std::size_t begin, std::size_t end) { \
    sum_nodal_pressure_range<D>(body, grid, begin, end);                                                              \
  }                                                                                                                   \
  template <>                                                                                                         \
  GEODROP_KERNEL void sum_nodal_rate<D>(const Body<D>& body, Grid<D>& grid, std::size_t begin, std::size_t end) {     \
    sum_nodal_rate_range<D>(body, grid, begin, end);                                                                  \
  }

}  // namespace geodrop
