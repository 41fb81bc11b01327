#include "picture_content.hpp"

#include <geodrop/measure/measure.hpp>

#include <algorithm>
#include <cmath>

namespace geodrop {
namespace {

bool has_triangles(const Snapshot& snapshot) { return snapshot.membranes.corners == 3; }

/// What has the values of a field.
enum class Carrier { particles, membranes };

bool has_values(const std::vector<Field>& fields, const std::string& name) {
  return std::ranges::count(value_names(fields), name) > 0;
}

Carrier carrier_of(const Snapshot& snapshot, const std::string& field) {
  const bool of_membranes = has_triangles(snapshot) && has_values(snapshot.membranes.fields, field) &&
                            !has_values(snapshot.particles.fields, field);
  return of_membranes ? Carrier::membranes : Carrier::particles;
}

/// Without the outermost 0.5 % of the values at either end; about zero where they have both signs.
ColourBar bar_of(PictureValues shown, const std::optional<ValueRange>& asked) {
  constexpr double outer = 0.5, both_signs = 0.2;
  std::erase_if(shown.values, [](double value) { return !std::isfinite(value); });
  ColourBar bar;
  bar.range = asked.value_or(ValueRange{percentile(shown.values, outer), percentile(shown.values, 100 - outer)});
  auto& [low, high] = bar.range;
  if (!std::isfinite(low) || !std::isfinite(high)) low = 0, high = 1;
  const double size = std::max(std::abs(low), std::abs(high));
  if (!asked && low < 0 && high > 0 && std::min(-low, high) > both_signs * size) {
    bar.scale = ColourScale::difference;
    low = -size;
    high = size;
  }
  if (high - low < 1e-6 * size || high == low) {  // one value: its colour is in the middle
    const double half = size > 0 ? 0.05 * size : 1;
    low -= half;
    high += half;
  }
  bar.unit = scaled_unit(shown.unit, size);
  bar.label = shown.label;
  return bar;
}

ColourBar membrane_bar(const PictureValues& values, const std::optional<ValueRange>& asked) {
  double largest = 0;
  for (const double value : values.values)
    if (std::isfinite(value)) largest = std::max(largest, value);
  ColourBar bar;
  bar.scale = ColourScale::heat;
  bar.range = asked.value_or(ValueRange{0, largest > 0 ? largest : 1});
  bar.unit = scaled_unit(values.unit, bar.range.second);
  bar.label = values.label;
  return bar;
}

/// Of one field in each view.
std::vector<PictureValues> values_in(const std::vector<PaintedView>& views, const std::string& field, Carrier carrier) {
  std::vector<PictureValues> values;
  for (const PaintedView& painted : views) {
    const Snapshot& frame = painted.view.frame;
    values.push_back(values_of(carrier == Carrier::membranes ? frame.membranes.fields : frame.particles.fields, field));
  }
  return values;
}

/// Those of all views, so that they share a scale.
PictureValues joined(const std::vector<PictureValues>& views) {
  PictureValues all = views.front();
  for (std::size_t v = 1; v < views.size(); ++v)
    all.values.insert(all.values.end(), views[v].values.begin(), views[v].values.end());
  return all;
}

void paint_categories(const Scene& scene, const std::string& field, PictureContent& content) {
  for (PaintedView& painted : content.views) {
    const ParticleSnapshot& particles = painted.view.frame.particles;
    Categories categories = field == "layers" ? layers_of(scene, particles) : materials_of(scene, particles);
    painted.colours = std::move(categories.colours);
    content.legend = std::move(categories.legend);
  }
}

void paint_values(const std::vector<PictureValues>& values, const std::optional<ValueRange>& asked,
                  PictureContent& content) {
  content.field = bar_of(joined(values), asked);
  for (std::size_t v = 0; v < values.size(); ++v)
    for (const double value : values[v].values) content.views[v].colours.push_back(content.field->colour(value));
}

void paint_lines(const PictureOptions& options, PictureContent& content) {
  std::vector<PictureValues> values = values_in(content.views, options.membrane, Carrier::membranes);
  content.membrane = membrane_bar(joined(values), options.tensions);
  for (std::size_t v = 0; v < values.size(); ++v) content.views[v].tensions = std::move(values[v].values);
}

}  // namespace

std::vector<std::string> picture_fields(const Snapshot& snapshot) {
  std::vector<std::string> names{"layers", "material"};
  const auto append = [&](const std::vector<std::string>& values) {
    names.insert(names.end(), values.begin(), values.end());
  };
  append(value_names(snapshot.particles.fields));
  if (has_triangles(snapshot)) append(value_names(snapshot.membranes.fields));
  return names;
}

std::string picture_field(const Snapshot& snapshot, const PictureOptions& options) {
  if (!options.field.empty()) return options.field;
  return has_triangles(snapshot) && snapshot.particles.points.empty() ? "tension" : "layers";
}

PictureContent content_of(const Scene& scene, const Snapshot& snapshot, const PictureOptions& options) {
  const std::string field = picture_field(snapshot, options);
  const Carrier carrier = carrier_of(snapshot, field);
  const Sight sight = carrier == Carrier::membranes ? Sight::outside : Sight::cut;
  PictureContent content;
  for (View& view : views_of(scene, snapshot, sight, options.cut)) content.views.push_back({std::move(view), {}, {}});
  if (field == "layers" || field == "material")
    paint_categories(scene, field, content);
  else
    paint_values(values_in(content.views, field, carrier), options.range, content);
  if (sight == Sight::cut && options.membrane != "none" && !snapshot.membranes.membrane.empty())
    paint_lines(options, content);
  return content;
}

}  // namespace geodrop
