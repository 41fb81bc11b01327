#include "mach_numbers.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/materials/materials.hpp>

#include <algorithm>

namespace geodrop {

std::vector<Fact> mach_numbers(const Scene& scene, const HistoryTable& history) {
  double speed = 0;
  for (const BodySpec& body : scene.bodies) {
    const std::size_t column = history.find(body.name + ".velocity_rms_m_s");
    for (const std::vector<double>& row : history.rows) speed = std::max(speed, row[column]);
  }
  std::vector<Fact> facts;
  for (const BodySpec& body : scene.bodies) {
    const Material material = make_material(*find_material(scene, body.material));
    if (std::holds_alternative<Newtonian>(material))
      facts.push_back({body.name + ".mach_ratio", speed / wave_speed(material)});
  }
  return facts;
}

}  // namespace geodrop
