// What is no mistake by the rules, but probably not what was meant: kN where N is asked for, water that hangs above its
// bed, output that fills the disk.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// A sentence for each: what was found, what is usual, what was probably meant. Units are not doubted in scenes without
/// gravity, which are often without dimension.
std::vector<std::string> doubts(const Scene& scene);

/// Of a calculator's option: a unit weight [N/m3] or density [kg/m3] of soil or water, a stiffness or strength [N/m] of
/// a geotextile that looks like one in kN/m3, t/m3 or kN/m. Empty if it does not.
std::string doubt_unit_weight(const std::string& name, double value);
std::string doubt_density(const std::string& name, double value);
std::string doubt_stiffness(const std::string& name, double value);
std::string doubt_strength(const std::string& name, double value);

}  // namespace geodrop
