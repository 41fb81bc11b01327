// How far the tension of a tube is from what its geotextile and seams bear.
#pragma once

#include <optional>

namespace geodrop {

/// Short-term strength and what reduces it in the structure; what is not given counts as 1.
struct TensionStrength {
  double strength;                        ///< of the geotextile, short-term, wide-width [N/m]
  std::optional<double> seam_efficiency;  ///< strength of a seam over that of the geotextile, 0 to 1
  std::optional<double> installation;     ///< reduction factors >= 1: damage at installation,
  std::optional<double> creep;            ///< creep,
  std::optional<double> durability;       ///< chemical and biological degradation,
  std::optional<double> seam;             ///< seams, where not given as efficiency
};

/// strength * seam efficiency / (installation * creep * durability * seam) [N/m].
inline double allowable_tension(const TensionStrength& given) {
  return given.strength * given.seam_efficiency.value_or(1) /
         (given.installation.value_or(1) * given.creep.value_or(1) * given.durability.value_or(1) *
          given.seam.value_or(1));
}

}  // namespace geodrop
