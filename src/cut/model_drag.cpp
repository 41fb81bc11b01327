#include "model_drag.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>

#include "cells_around.hpp"
#include "geometry/polygon.hpp"
#include "membrane/fluid_load.hpp"

namespace geodrop {
namespace {

Vec<2> mean_velocity(const Body<2>& body) {
  Vec<2> momentum = Vec<2>::Zero();
  double mass = 0;
  for (std::size_t p = 0; p < body.size(); ++p) {
    momentum += body.mass[p] * vector_at(body.v, p);
    mass += body.mass[p];
  }
  return momentum / mass;
}

}  // namespace

void add_model_drag(State<2>& state) {
  for (Membrane<2>& membrane : state.membranes) {
    if (!acts_sharply(membrane) || membrane.drag_coefficient == 0) continue;
    const Vec<2> v = mean_velocity(find_named(state.bodies, membrane.body));
    const double sense = sense_of(membrane);
    for (std::size_t k = 0; k < membrane.segments(); ++k) {
      if (membrane.water_pressure[k] <= 0) continue;
      const std::size_t end = end_of_edge(k, membrane.nodes());
      const Vec<2> along = vector_at(membrane.x, end) - vector_at(membrane.x, k);
      const double faces = sense * (along[1] * v[0] - along[0] * v[1]);  // n . v times the length
      const Vec<2> half = -0.25 * membrane.fluid_density * membrane.drag_coefficient * std::max(0.0, faces) * v;
      for (const std::size_t node : {k, end})
        for (int a = 0; a < 2; ++a) membrane.load[a][node] += half[a];
    }
  }
}

}  // namespace geodrop
