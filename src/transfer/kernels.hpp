// Entries of the hot loops. Each works on a range of one body's particles and knows nothing of threads.
#pragma once

#include "gather.hpp"

namespace geodrop {

/// Adds mass, momentum and stress force of particles [begin, end) to the grid. If the grid has no separate force
/// record, dt times the force joins the momentum.
template <int Dim, class Basis>
void scatter(const Body<Dim>& body, Grid<Dim>& grid, double dt, std::size_t begin, std::size_t end);

/// Moves particles [begin, end), updates their volume and stress.
template <int Dim, class Basis>
Maxima gather(Body<Dim>& body, const Grid<Dim>& grid, const GatherOptions& options, std::size_t begin, std::size_t end);

/// Adds V_p, and V_p p_p of bodies with cell pressure, to the base cells of particles [begin, end).
template <int Dim>
void sum_cells(const Body<Dim>& body, Grid<Dim>& grid, std::size_t begin, std::size_t end);

/// Adds N V and N V p of particles [begin, end) to the nodes of their simplices.
template <int Dim>
void sum_nodal_pressure(const Body<Dim>& body, Grid<Dim>& grid, std::size_t begin, std::size_t end);

/// Adds N V tr L of particles [begin, end) to the nodes of their simplices.
template <int Dim>
void sum_nodal_rate(const Body<Dim>& body, Grid<Dim>& grid, std::size_t begin, std::size_t end);

/// MUSL: velocity of particles [begin, end) from the grid.
template <int Dim, class Basis>
void update_velocity(Body<Dim>& body, const Grid<Dim>& grid, const GatherOptions& options, std::size_t begin,
                     std::size_t end);

/// What particles give to the nodes by their mass: m u in the first lanes, m unit_mass in lane 3.
template <int Dim>
struct ByMass {
  std::array<const double*, Dim> u;
  double unit_mass;
};

/// Adds N m (u, unit_mass) of particles [begin, end) to the records `sum` of the nodes.
template <int Dim, class Basis>
void sum_by_mass(const Body<Dim>& body, const ByMass<Dim>& what, const GridLayout<Dim>& layout, Vec4* sum,
                 std::size_t begin, std::size_t end);

/// Calls f(basis policy) for the basis of the grid: one switch per range of particles.
template <int Dim, class F>
auto with_basis(const GridLayout<Dim>& layout, F&& f) {
  switch (layout.basis) {
    case Basis::gimp:
      return f(Gimp{});
    case Basis::linear:
      return f(Linear{});
    case Basis::tri3:
    case Basis::tet4:
      return f(Simplex{});
    case Basis::bspline2:
      break;
  }
  if (layout.graded()) return f(GradedBspline2{});
  return f(Bspline2{});
}

template <int Dim>
void scatter(const Body<Dim>& body, Grid<Dim>& grid, double dt, std::size_t begin, std::size_t end) {
  with_basis(grid.layout, [&](auto basis) { scatter<Dim, decltype(basis)>(body, grid, dt, begin, end); });
}

template <int Dim>
Maxima gather(Body<Dim>& body, const Grid<Dim>& grid, const GatherOptions& options, std::size_t begin,
              std::size_t end) {
  return with_basis(grid.layout,
                    [&](auto basis) { return gather<Dim, decltype(basis)>(body, grid, options, begin, end); });
}

template <int Dim>
void update_velocity(Body<Dim>& body, const Grid<Dim>& grid, const GatherOptions& options, std::size_t begin,
                     std::size_t end) {
  with_basis(grid.layout, [&](auto basis) { update_velocity<Dim, decltype(basis)>(body, grid, options, begin, end); });
}

template <int Dim>
void sum_by_mass(const Body<Dim>& body, const ByMass<Dim>& what, const GridLayout<Dim>& layout, Vec4* sum,
                 std::size_t begin, std::size_t end) {
  with_basis(layout, [&](auto basis) { sum_by_mass<Dim, decltype(basis)>(body, what, layout, sum, begin, end); });
}

}  // namespace geodrop
