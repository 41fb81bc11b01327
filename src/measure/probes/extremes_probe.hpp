// The worst of all particles of a body: what a hard case asks for.
#pragma once

#include <limits>

#include "probe.hpp"

namespace geodrop {

struct Extremes {
  static constexpr double none = std::numeric_limits<double>::infinity();
  double volume_min = none, volume_max = -none;      ///< of J [-]
  double pressure_min = none, pressure_max = -none;  ///< [Pa]
  double tension = -none;                            ///< largest principal stress, in soil the effective one [Pa]

  Extremes& operator+=(const Extremes& other);
};
template <int Dim>
Extremes extremes_of(const Body<Dim>& body);

struct ExtremesProbeSpec {
  static constexpr const char* word = "extremes";
  static constexpr const char* meaning =
      "least and largest volume ratio J and pressure, largest principal stress (effective in soil) of all particles";

  std::string name;
  std::string body;
  bool operator==(const ExtremesProbeSpec&) const = default;

  static std::vector<Key> rows() {
    constexpr RowsOf<ExtremesProbeSpec> key;
    return {key("body", &ExtremesProbeSpec::body, required, reference, "whose particles")};
  }
  void check(const ProbeCheck& probe) const { probe.body(body); }

  template <int Dim>
  void list(HistoryRow& row, const Scene&, const State<Dim>* state) const {
    const Extremes extremes = state ? extremes_of(find_named(state->bodies, body)) : Extremes{};
    row.add(name + ".volume_min_ratio", extremes.volume_min);
    row.add(name + ".volume_max_ratio", extremes.volume_max);
    row.add(name + ".pressure_min_Pa", extremes.pressure_min);
    row.add(name + ".pressure_max_Pa", extremes.pressure_max);
    row.add(name + ".tension_max_Pa", extremes.tension);
  }
};

}  // namespace geodrop
