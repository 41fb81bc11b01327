#include "doubts.hpp"

#include "doubtful_gaps.hpp"
#include "doubtful_setting.hpp"
#include "doubtful_units.hpp"

namespace geodrop {

std::vector<std::string> doubts(const Scene& scene) {
  std::vector<std::string> all = doubtful_units(scene);
  for (auto& list : {doubtful_water(scene), doubtful_gaps(scene), doubtful_numerics(scene), doubtful_output(scene)})
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace geodrop
