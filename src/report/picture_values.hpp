// What particles and membranes are coloured by.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <string>
#include <utility>
#include <vector>

#include "colours.hpp"
#include "files/snapshot.hpp"

namespace geodrop {

/// A number for each particle or segment.
struct PictureValues {
  std::string label;  ///< "velocity"
  std::string unit;   ///< "m/s"; "1": none
  std::vector<double> values;
};

/// A name and its colour in the legend.
struct LegendEntry {
  std::string name;
  Colour colour;
};

/// A colour for each particle, and what they stand for.
struct Categories {
  std::vector<Colour> colours;
  std::vector<LegendEntry> legend;
};

/// Names that values_of understands: "velocity" (its length), "velocity_x", "stress_yy", "density", ...
std::vector<std::string> value_names(const std::vector<Field>& fields);

/// `name` is one of value_names.
PictureValues values_of(const std::vector<Field>& fields, const std::string& name);

/// Whether a body of water is in the pores of a soil and nowhere else: pictures show the soil in its place.
bool lies_in_pores(const Scene& scene, const BodySpec& water);

/// Layers: bodies in the colours of the kinds of their materials, darker and lighter in turn where they have layers.
/// Soil in a membrane differs from soil around it.
Categories layers_of(const Scene& scene, const ParticleSnapshot& particles);
Categories materials_of(const Scene& scene, const ParticleSnapshot& particles);

}  // namespace geodrop
