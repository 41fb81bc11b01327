#include "picture_values.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include "scene/needs.hpp"

namespace geodrop {
namespace {

/// Beginnings of the names of fields with a unit.
constexpr std::pair<std::string_view, std::string_view> units[] = {
    {"velocity", "m/s"},         {"displacement", "m"},    {"stress", "Pa"},
    {"mean_pressure", "Pa"},     {"pore_pressure", "Pa"},  {"density", "kg/m3"},
    {"contents_pressure", "Pa"}, {"water_pressure", "Pa"}, {"tension", "N/m"},
    {"cross_tension", "N/m"}};

std::string unit_of_field(const std::string& name) {
  for (const auto& [beginning, unit] : units)
    if (name.starts_with(beginning)) return std::string(unit);
  return "1";
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Vectors have a length worth showing, tensors components only.
bool is_vector(const Field& field) { return field.components.size() == 3; }

struct Base {
  Colour light, dark;
};
constexpr std::array waters = {Base{{186, 219, 240}, {160, 200, 228}}, Base{{205, 228, 216}, {178, 210, 194}}};
constexpr std::array soils = {Base{{214, 178, 112}, {150, 106, 58}}, Base{{176, 166, 130}, {138, 128, 94}},
                              Base{{206, 150, 126}, {160, 98, 76}}, Base{{190, 190, 120}, {140, 140, 76}}};
constexpr std::array others = {Base{{190, 184, 204}, {146, 138, 168}}, Base{{178, 200, 178}, {128, 156, 128}}};

/// Colours of what is of one kind, in turn.
class Palette {
 public:
  Base next_water() { return waters[water_++ % waters.size()]; }
  Base next_soil() { return soils[soil_++ % soils.size()]; }
  Base next_fill() { return soils[2 * fill_++ % soils.size()]; }
  Base next_ground() { return soils[(2 * ground_++ + 1) % soils.size()]; }
  Base next_other() { return others[other_++ % others.size()]; }

 private:
  std::size_t water_ = 0, soil_ = 0, fill_ = 0, ground_ = 0, other_ = 0;
};

bool is_fluid(const MaterialSpec& material) { return std::holds_alternative<NewtonianSpec>(material.model); }
bool is_soil(const MaterialSpec& material) { return std::holds_alternative<MohrCoulombSpec>(material.model); }

std::vector<Base> colours_of_materials(const Scene& scene) {
  Palette palette;
  std::vector<Base> colours;
  for (const MaterialSpec& material : scene.materials)
    colours.push_back(is_fluid(material)  ? palette.next_water()
                      : is_soil(material) ? palette.next_soil()
                                          : palette.next_other());
  return colours;
}

/// A soil in a membrane and one around it have different colours also where both are of one material.
std::vector<Base> colours_of_bodies(const Scene& scene) {
  Palette palette;
  std::vector<Base> colours;
  for (const BodySpec& body : scene.bodies) {
    const MaterialSpec& material = *find_material(scene, body.material);
    if (lies_in_pores(scene, body))
      colours.push_back(waters.front());  // is not drawn
    else if (is_fluid(material))
      colours.push_back(palette.next_water());
    else if (is_soil(material))
      colours.push_back(in_geotextile(scene, body) ? palette.next_fill() : palette.next_ground());
    else
      colours.push_back(palette.next_other());
  }
  return colours;
}

}  // namespace

std::vector<std::string> value_names(const std::vector<Field>& fields) {
  std::vector<std::string> names;
  for (const Field& field : fields) {
    if (field.components.empty() || is_vector(field)) names.push_back(field.name);
    for (const std::string& component : field.components) names.push_back(field.name + "_" + lower(component));
  }
  return names;
}

PictureValues values_of(const std::vector<Field>& fields, const std::string& name) {
  PictureValues result{name, unit_of_field(name), {}};
  std::ranges::replace(result.label, '_', ' ');
  for (const Field& field : fields) {
    const std::size_t width = field.width();
    for (std::size_t c = 0; c < field.components.size(); ++c)
      if (name == field.name + "_" + lower(field.components[c]))
        for (std::size_t i = c; i < field.values.size(); i += width)
          result.values.push_back(static_cast<double>(field.values[i]));
    if (name != field.name) continue;
    for (std::size_t i = 0; i + width <= field.values.size(); i += width) {
      double sum = 0;
      for (std::size_t c = 0; c < width; ++c) sum += std::pow(static_cast<double>(field.values[i + c]), 2);
      result.values.push_back(width == 1 ? static_cast<double>(field.values[i]) : std::sqrt(sum));
    }
  }
  return result;
}

bool lies_in_pores(const Scene& scene, const BodySpec& water) {
  return std::ranges::any_of(
      scene.bodies, [&](const BodySpec& soil) { return soil.saturated_by == water.name && soil.shape == water.shape; });
}

Categories layers_of(const Scene& scene, const ParticleSnapshot& particles) {
  const std::vector<Base> bases = colours_of_bodies(scene);
  Categories result;
  for (std::size_t p = 0; p < particles.body.size(); ++p) {
    const Base& base = bases.at(particles.body[p]);
    result.colours.push_back(particles.layer.at(p) % 2 == 0 ? base.light : base.dark);
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodySpec& body = scene.bodies[b];
    if (lies_in_pores(scene, body)) continue;
    const Base& base = bases[b];
    result.legend.push_back({body.name + (body.layers > 1 ? ", layers" : ""), base.light});
    if (body.layers > 1) result.legend.push_back({"", base.dark});
  }
  return result;
}

Categories materials_of(const Scene& scene, const ParticleSnapshot& particles) {
  const std::vector<Base> bases = colours_of_materials(scene);
  Categories result;
  for (const std::uint32_t material : particles.material) result.colours.push_back(bases.at(material).light);
  for (std::size_t m = 0; m < bases.size(); ++m) result.legend.push_back({scene.materials[m].name, bases[m].light});
  return result;
}

}  // namespace geodrop
