// Warnings of a run that leaves the range in which its models hold.
#pragma once

#include <geodrop/measure/history.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <set>
#include <string>
#include <vector>

namespace geodrop {

/// Tells of each limit that was passed once: a fluid at more than 0.3 of its wave speed or 10 % denser than without
/// pressure, where it is no longer weakly compressible; a closed membrane whose outline encloses more than 1 % above
/// what it did at the start, without a pump; a membrane of which a part has left the cells of grid.refine that another
/// part is in.
class LimitWatch {
 public:
  /// What is new since the last call; rows of the history that were not looked at before are looked at first.
  template <int Dim>
  std::vector<std::string> look(const Scene& scene, const State<Dim>& state, const HistoryTable& history);

 private:
  void look_at_row(const Scene& scene, const HistoryTable& history, std::size_t row);
  template <int Dim>
  void look_at_density(const Body<Dim>& body, double t);
  template <int Dim>
  void look_at_cells(const GridSpec& grid, const Membrane<Dim>& membrane, double t);
  void say(const std::string& what, const std::string& text);

  std::size_t rows_seen_ = 0;
  std::set<std::string> said_;
  std::vector<std::string> new_;
};

}  // namespace geodrop
