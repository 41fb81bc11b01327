// The worst of all particles of a body: what a hard case asks for.
#pragma once

#include <geodrop/state.hpp>

#include <limits>

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

}  // namespace geodrop
