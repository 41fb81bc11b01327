// What a picture of a frame shows: views with the colours of all that is in them, legend and scales.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/figures.hpp"
#include "colours.hpp"
#include "picture_values.hpp"
#include "picture_views.hpp"

namespace geodrop {

using ValueRange = std::pair<double, double>;  ///< in SI units

struct PictureOptions {
  std::string field;                   ///< one of picture_fields; empty: layers, or tension where membranes are alone
  std::string membrane = "tension";    ///< a field of membranes for their lines, or "none"
  std::optional<Extent> window;        ///< empty: whole_extent
  std::optional<ValueRange> range;     ///< of the field; empty: of the frames drawn
  std::optional<ValueRange> tensions;  ///< of the lines of membranes; empty: from 0 to the largest
  std::optional<std::array<double, 2>> cut;  ///< see views_of
};

/// Fields that a frame may be coloured by: layers, material, those of particles, in space those of membranes.
std::vector<std::string> picture_fields(const Snapshot& snapshot);

/// The field that is drawn if options say nothing.
std::string picture_field(const Snapshot& snapshot, const PictureOptions& options);

/// A scale of colours with its bar.
struct ColourBar {
  ColourScale scale = ColourScale::viridis;
  ValueRange range;  ///< in SI units
  Scaled unit;
  std::string label;

  Colour colour(double value) const { return colour_at(scale, (value - range.first) / (range.second - range.first)); }
};

/// A view with its colours.
struct PaintedView {
  View view;
  std::vector<Colour> colours;   ///< of particles; of triangles where the frame has those
  std::vector<double> tensions;  ///< or another field of the segments of membranes
};

struct PictureContent {
  std::vector<PaintedView> views;
  std::vector<LegendEntry> legend;
  std::optional<ColourBar> field, membrane;  ///< the same for all views
};

PictureContent content_of(const Scene& scene, const Snapshot& snapshot, const PictureOptions& options);

}  // namespace geodrop
