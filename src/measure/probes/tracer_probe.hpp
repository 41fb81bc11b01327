// A massless point that moves with the grid velocity.
#pragma once

#include "probe.hpp"

namespace geodrop {

struct TracerSpec {
  static constexpr const char* word = "tracer";
  static constexpr const char* meaning = "a point that moves with the material";

  std::string name;
  Point position;  ///< [m]
  bool operator==(const TracerSpec&) const = default;

  static std::vector<Key> rows() {
    constexpr RowsOf<TracerSpec> key;
    return {key("position", &TracerSpec::position, "m", required, any, "where the point starts")};
  }
  void check(const ProbeCheck& probe) const {
    const auto& [lower, upper] = std::tie(probe.scene.grid.lower, probe.scene.grid.upper);
    if (!probe.report.healthy(probe.key) || !probe.report.healthy("grid") || position.size() != lower.size()) return;
    for (std::size_t a = 0; a < position.size(); ++a) {
      if (position[a] >= lower[a] && position[a] <= upper[a]) continue;
      probe.report.add(probe.key + ".position", to_text(position),
                       "a point inside the grid, from " + to_text(lower) + " to " + to_text(upper) + " [m]");
      return;
    }
  }
  template <int Dim>
  void list(HistoryRow& row, const Scene&, const State<Dim>* state) const {
    const Tracer<Dim> tracer = state ? find_named(state->tracers, name) : Tracer<Dim>{};
    std::array<double, Dim> displacement;
    for (int a = 0; a < Dim; ++a) displacement[a] = tracer.x[a] - tracer.initial_x[a];
    row.add_vector(name + ".position", "m", tracer.x, Dim);
    row.add_vector(name + ".displacement", "m", displacement, Dim);
    row.add_vector(name + ".velocity", "m_s", tracer.v, Dim);
  }
};

}  // namespace geodrop
