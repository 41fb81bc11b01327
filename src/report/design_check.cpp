#include "design_check.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/geometry/shapes.hpp>

#include <algorithm>
#include <cmath>

#include "scene/needs.hpp"

namespace geodrop {
namespace {

std::vector<const char*> axes_of(const Scene& scene) {
  return scene.dimension == 2 ? std::vector{"x", "y"} : std::vector{"x", "y", "z"};
}

bool is_bed(const Scene& scene, const std::string& bed, const BodySpec& body) {
  if (!bed.empty()) return body.name == bed;
  const MaterialSpec* const material = find_or_null(scene.materials, body.material);
  return material && !std::holds_alternative<NewtonianSpec>(material->model) && !in_geotextile(scene, body);
}

/// The upper end of a body in the column at x, below what is cut out of its top.
std::optional<double> top_at(const Scene& scene, const BodySpec& body, double x) {
  const auto column = [&](const Shape& shape) { return chords(shape, {x, 0}, 1); };
  const std::vector<Chord> own = column(body.shape);
  if (own.empty()) return std::nullopt;
  double top = own.back().to;
  for (const std::string& name : body.minus)
    if (const BodySpec* const other = find_or_null(scene.bodies, name))
      for (const Chord& cut : column(other->shape))
        if (cut.from < top && top <= cut.to) top = cut.from;
  return top;
}

}  // namespace

std::optional<double> bed_surface(const Scene& scene, const std::string& bed, double x) {
  std::optional<double> surface;
  for (const BodySpec& body : scene.bodies)
    if (is_bed(scene, bed, body)) surface = std::max(surface, top_at(scene, body, x));  // nothing is below all else
  return surface;
}

std::vector<PeakTension> peak_tensions(const Scene& scene, const CsvTable& history) {
  std::vector<PeakTension> peaks;
  for (const MembraneSpec& membrane : scene.membranes) {
    const std::string column = membrane.name + ".tension_gauge";
    if (!history.has(column + "_N_m") || !history.has(column + "_time_s")) continue;
    const std::vector<double>& tension = history.column(column + "_N_m");
    const auto largest =
        std::ranges::max_element(tension, {}, [](double value) { return std::isnan(value) ? 0 : value; });
    const auto row = static_cast<std::size_t>(largest - tension.begin());
    const auto at = [&](const std::string& ending) { return history.column(column + ending)[row]; };
    std::vector<double> place;
    for (const char* axis : axes_of(scene)) place.push_back(at(std::string("_") + axis + "_m"));
    peaks.push_back({membrane.name, *largest, at("_time_s"), place, membrane.strength});
  }
  return peaks;
}

std::optional<double> safety(const PeakTension& peak, TensionStrength factors) {
  if (peak.strength <= 0 || !(peak.tension > 0)) return std::nullopt;
  factors.strength = peak.strength;
  return allowable_tension(factors) / peak.tension;
}

std::vector<RestingPlace> resting_places(const Scene& scene, const CsvTable& history) {
  std::vector<RestingPlace> places;
  for (const MembraneSpec& membrane : scene.membranes) {
    const std::string body = body_inside(scene, membrane);
    if ((scene.dimension == 2 && !membrane.closed) || !history.has(body + ".height_m")) continue;
    if (std::ranges::find(places, body, &RestingPlace::body) != places.end()) continue;
    const auto last = [&](const std::string& ending) { return history.column(body + ending).back(); };
    RestingPlace place;
    place.body = body;
    place.time = history.column("time_s").back();
    double squares = 0;
    for (const std::string axis : axes_of(scene)) {
      place.centre.push_back(last(".position_" + axis + "_m"));
      squares += std::pow(last(".velocity_" + axis + "_m_s"), 2);
    }
    place.speed = std::sqrt(squares);
    place.height = last(".height_m");
    place.width = last(".width_m");
    place.lowest = last(".lowest_m");
    if (scene.dimension == 2) {
      place.turn_deg = last(".rotation_deg");
      if (const std::optional<double> surface = bed_surface(scene, membrane.bed, place.centre[0]))
        place.burial = *surface - place.lowest;
    } else {
      place.turn_deg = std::hypot(last(".rotation_x_deg"), last(".rotation_y_deg"), last(".rotation_z_deg"));
      place.depth = last(".backmost_m") - last(".frontmost_m");
    }
    places.push_back(place);
  }
  return places;
}

}  // namespace geodrop
