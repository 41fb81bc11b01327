// From the run-time transfer to the compiled kernel: one switch per range, none per particle.
//
// Each (dimension, basis) is compiled in a translation unit of its own: GEODROP_KERNELS(dimension, basis policy), and
// for simplices GEODROP_NODAL_KERNELS(dimension).
#pragma once

#include "kernels.hpp"
#include "transfer/baseline/remap.hpp"

namespace geodrop {

template <int Dim, class Basis, class Arithmetic>
void scatter_dispatch(const Body<Dim>& body, Grid<Dim>& grid, double dt, std::size_t begin, std::size_t end) {
  if (grid.force.empty())
    scatter_range<Dim, Basis, false, Arithmetic>(body, grid, dt, begin, end);
  else
    scatter_range<Dim, Basis, true, Arithmetic>(body, grid, dt, begin, end);
}

template <int Dim, class Basis, class Arithmetic>
Maxima gather_dispatch(Body<Dim>& body, const Grid<Dim>& grid, const GatherOptions& options, std::size_t begin,
                       std::size_t end) {
  if constexpr (has_affine<Basis>) {
    if (options.transfer == Transfer::tpic)
      return gather_range<Dim, Basis, Transfer::tpic, Arithmetic>(body, grid, options, begin, end);
    if (options.transfer == Transfer::blend)
      return gather_range<Dim, Basis, Transfer::blend, Arithmetic>(body, grid, options, begin, end);
  }
  return gather_range<Dim, Basis, Transfer::musl, Arithmetic>(body, grid, options, begin, end);
}

// Macros, because the entries are explicit specialisations: nothing that calls them sees their bodies.
#define GEODROP_KERNELS(D, B)                                                                                          \
  template <>                                                                                                          \
  void scatter<D, B>(const Body<D>& body, Grid<D>& grid, double dt, std::size_t begin, std::size_t end) {              \
    with_level([&](auto arithmetic) { scatter_dispatch<D, B, decltype(arithmetic)>(body, grid, dt, begin, end); });    \
  }                                                                                                                    \
  template <>                                                                                                          \
  Maxima gather<D, B>(Body<D> & body, const Grid<D>& grid, const GatherOptions& options, std::size_t begin,            \
                      std::size_t end) {                                                                               \
    return with_level([&](auto arithmetic) {                                                                           \
      return gather_dispatch<D, B, decltype(arithmetic)>(body, grid, options, begin, end);                             \
    });                                                                                                                \
  }                                                                                                                    \
  template <>                                                                                                          \
  void update_velocity<D, B>(Body<D> & body, const Grid<D>& grid, const GatherOptions& options, std::size_t begin,     \
                             std::size_t end) {                                                                        \
    with_level(                                                                                                        \
        [&](auto arithmetic) { update_velocity_range<D, B, decltype(arithmetic)>(body, grid, options, begin, end); }); \
  }                                                                                                                    \
  template <>                                                                                                          \
  void sum_by_mass<D, B>(const Body<D>& body, const ByMass<D>& what, const GridLayout<D>& layout, Vec4* sum,           \
                         std::size_t begin, std::size_t end) {                                                         \
    with_level(                                                                                                        \
        [&](auto arithmetic) { sum_by_mass_range<D, B, decltype(arithmetic)>(body, what, layout, sum, begin, end); }); \
  }

#define GEODROP_NODAL_KERNELS(D)                                                                                 \
  template <>                                                                                                    \
  void sum_nodal_pressure<D>(const Body<D>& body, Grid<D>& grid, std::size_t begin, std::size_t end) {           \
    with_level([&](auto) { sum_nodal_pressure_range<D>(body, grid, begin, end); });                              \
  }                                                                                                              \
  template <>                                                                                                    \
  void sum_nodal_rate<D>(const Body<D>& body, Grid<D>& grid, std::size_t begin, std::size_t end) {               \
    with_level([&](auto arithmetic) { sum_nodal_rate_range<D, decltype(arithmetic)>(body, grid, begin, end); }); \
  }

}  // namespace geodrop
