// Spread of the total vertical stress over the particles of a body.
#pragma once

#include "probe.hpp"

namespace geodrop {

struct StressProbeSpec {
  static constexpr const char* word = "stress";
  static constexpr const char* meaning = "how the vertical stress spreads over the particles";

  std::string name;
  std::string body;
  bool operator==(const StressProbeSpec&) const = default;

  static std::vector<Key> rows() {
    constexpr RowsOf<StressProbeSpec> key;
    return {key("body", &StressProbeSpec::body, required, reference, "whose particles")};
  }
  void check(const ProbeCheck& probe) const { probe.body(body); }

  template <int Dim>
  void list(HistoryRow& row, const Scene&, const State<Dim>* state) const {
    std::vector<double> stress;
    if (state) {
      const Body<Dim>& found = find_named(state->bodies, body);
      for (std::size_t p = 0; p < found.size(); ++p) stress.push_back(total_stress(found, p)[vertical_axis<Dim>]);
    }
    for (const auto& [column, percent] : {std::pair{"p01", 1.0}, std::pair{"p50", 50.0}, std::pair{"p99", 99.0}})
      row.add(name + ".vertical_stress_" + column + "_Pa", state ? percentile(stress, percent) : 0.0);
  }
};

}  // namespace geodrop
