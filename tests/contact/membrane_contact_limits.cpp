// Contact of membranes: whose stiffness counts, and how deep the own folds of an open membrane press.
#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include <algorithm>
#include <cmath>

#include "contact/membrane_contact.hpp"
#include "membrane/membrane_force.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double stiffness = 2e5, reach = 0.2, spacing = 0.1;

/// An open membrane folded over from the right, its lower lip `depth` above its upper one, the body around it.
State<2> hairpin(double depth) {
  Membrane<2> m;
  m.name = m.body = "bag";
  m.closed = false;
  const auto add = [&](double x, double y) {
    m.x[0].push_back(x);
    m.x[1].push_back(y);
  };
  for (int k = 20; k >= 0; --k) add(spacing * k, 0.5 * depth);
  for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {-1.0, 0.0}, {-0.5, 0.5}}) add(x, y);
  for (int k = 0; k <= 20; ++k) add(spacing * k, -0.5 * depth);
  const std::size_t n = m.x[0].size();
  for (auto* values : {&m.v, &m.load})
    for (auto& component : *values) component.assign(n, 0.0);
  m.mass.assign(n, 1.0);
  for (std::size_t s = 0; s + 1 < n; ++s)
    m.rest_length.push_back(std::hypot(m.x[0][s + 1] - m.x[0][s], m.x[1][s + 1] - m.x[1][s]));
  State<2> state;
  state.membranes = {m};
  MembraneContact<2> contact{{"bag", "bag"}, {1, 1}, 0.3, stiffness, 0, reach, {}};
  contact.slip = {Array<double>(n, 0.0), Array<double>(n, 0.0)};
  state.membrane_contacts = {contact};
  return state;
}

}  // namespace

TEST_CASE("Own folds of an open membrane press with stiffness times depth, down to a quarter of the reach") {
  for (const double depth : {0.001, 0.03, 0.049, 0.051, 0.1}) {
    CAPTURE(depth);
    State<2> state = hairpin(depth);
    clear_membrane_loads(state);
    add_membrane_contacts(state, 0.01);
    const Membrane<2>& bag = state.membranes[0];
    const double whole = stiffness * depth * spacing;
    const double expected = depth < 0.25 * reach ? whole : 0.0;
    const std::size_t last = bag.nodes() - 1;
    for (std::size_t k = 4; k <= 16; ++k) {  // clear of the lips' tips and of the fold
      CHECK(bag.load[1][k] == within(-expected, 1e-9 * whole));
      CHECK(bag.load[1][last - k] == within(expected, 1e-9 * whole));
    }
  }
}

TEST_CASE("The softer body makes the stiffness of a contact, whichever of the two is named first") {
  const double soft = 1e6 * 0.75 / (1.25 * 0.5), h = 0.125;  // wave modulus for E = 1 MPa, nu = 0.25
  for (const char* body : {"slab", "block"}) {
    CAPTURE(body);
    const Scene scene = read_scene(source_path("tests/scenes/block_on_slab.toml"),
                                   {"materials.soft={model='linear_elastic',density=900.0,youngs_modulus=1e6,"
                                    "poissons_ratio=0.25}",
                                    "bodies." + std::string(body) + ".material=soft"});
    const State<2> state = build_state<2>(scene);
    REQUIRE(state.membrane_contacts.size() == 1);
    CHECK(state.membrane_contacts[0].stiffness == near(soft / h, 1e-12));
  }
}
