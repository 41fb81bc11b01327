// A row of the step: a named, timed piece with what it reads and writes. Rows are made in the rooms of their physics
// (grid/rows.hpp and so on); step.cpp puts them in order.
//
// What a row only reads its function takes as const. What else it leaves alone a debug build checks by hashes.
#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <utility>

#include <geodrop/grid/data.hpp>

namespace geodrop {

struct Scene;

/// What is fixed for the duration of one step; the first row sets `dt`.
struct StepContext {
  double dt = 0;  ///< [s]
  double t = 0;   ///< at the start of the step [s]
  std::uint64_t step = 0;
};

template <int Dim>
using RunRow = std::function<void(State<Dim>&, Grids<Dim>&, StepContext&)>;

template <int Dim>
struct Row {
  std::string name;
  DataSet reads, writes;
  bool wanted;  ///< the scene's physics needs it
  RunRow<Dim> run;
  double seconds = 0;  ///< wall time so far
};

/// What each velocity field needs: f(state, grid, step) for one after the other.
template <int Dim, class F>
RunRow<Dim> each_field(F f) {
  return [f](State<Dim>& state, Grids<Dim>& grids, const StepContext& step) {
    for (Grid<Dim>& grid : grids) f(state, grid, step);
  };
}

/// A function that makes a row from what it needs to know of the scene. In space the rows of the plane are none, and in
/// the plane those of space.
template <int Dim>
struct RowMaker {
  Row<Dim> (*make)(const Scene&) = nullptr;

  RowMaker(Row<Dim> (*maker)(const Scene&)) : make(maker) {}
  RowMaker(Row<2> (*)(const Scene&)) requires(Dim == 3) {}
  RowMaker(Row<3> (*)(const Scene&)) requires(Dim == 2) {}
};

}  // namespace geodrop
