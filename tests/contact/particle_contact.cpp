// Bare particles on rigid surfaces: what reaches the grid, which particles count, and how far they reach.
#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include <cmath>
#include <numeric>

#include "contact/surface_contact.hpp"
#include "grid/sort_particles.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

const std::string scene_file = "tests/scenes/ramp.toml";

struct Ready {
  Scene scene;
  State<2> state;
  Grids<2> grids;
  Grid<2>& grid = grids[0];

  explicit Ready(const std::vector<std::string>& settings = {})
      : scene(read_scene(source_path(scene_file), settings)),
        state(build_state<2>(scene)),
        grids(make_grids<2>(scene)) {
    sort_particles_if_due(state, grids);
  }
  RigidContact<2>& contact() { return find_named_contact("block"); }
  RigidContact<2>& find_named_contact(const std::string& touching) {
    for (RigidContact<2>& contact : state.rigid_contacts)
      if (contact.touching == touching) return contact;
    throw std::runtime_error("no contact of " + touching);
  }
  Body<2>& block() { return state.bodies[0]; }
  /// Moves the block [m] against the normal of the ramp, into it.
  void sink(double depth) {
    for (int a = 0; a < 2; ++a)
      for (double& x : block().x[a]) x -= depth * state.rigid[0].normal[a];
  }
};

}  // namespace

TEST_CASE("A block that lies on an inclined surface just touches it, with most of the length of its side") {
  Ready it;
  contact_to_grid(it.state, it.grid, 1e-3);
  CHECK(it.contact().normal_sum < 1e-9 * it.contact().stiffness);
  constexpr double depth = 1e-4;
  it.sink(depth);
  contact_to_grid(it.state, it.grid, 1e-3);
  // The side is 1 m long; shares that are triangles count three quarters of theirs.
  const double length = it.contact().normal_sum / (it.contact().stiffness * depth);
  CHECK(length > 0.75);
  CHECK(length < 1);
  CHECK(it.contact().points.size() > 15);
}

TEST_CASE("What the grid gets is the sum of the forces") {
  Ready it;
  it.sink(1e-3);
  contact_to_grid(it.state, it.grid, 1e-3);
  double sum[2] = {};
  for (const Vec4& f : it.grid.force)
    for (int a = 0; a < 2; ++a) sum[a] += f[a];
  CHECK(it.contact().normal_sum > 100);
  for (int a = 0; a < 2; ++a)
    CHECK(sum[a] == near(it.contact().normal_force[a] + it.contact().friction_force[a], 1e-10));
  CHECK(std::hypot(it.contact().normal_force[0], it.contact().normal_force[1]) == near(it.contact().normal_sum, 1e-12));
}

TEST_CASE("No particle that touches is missed, wherever the surface is") {
  Ready it;
  for (const double depth : {0.0, 0.05, 0.3, 0.9}) {
    CAPTURE(depth);
    Ready deep;
    deep.sink(depth);
    const RigidSurface surface(deep.state.rigid[0]);
    std::vector<std::uint32_t> expected;
    for (std::size_t p = 0; p < deep.block().size(); ++p) {
      const auto gap = surface.gap(vector_at(deep.block().x, p), 0);
      if (gap && gap->size < deep.contact().reach[deep.block().id[p]]) expected.push_back(deep.block().id[p]);
    }
    std::sort(expected.begin(), expected.end());
    contact_to_grid(deep.state, deep.grid, 1e-3);
    CHECK(std::vector<std::uint32_t>(deep.contact().points.begin(), deep.contact().points.end()) == expected);
  }
}

TEST_CASE("Springs belong to particles, in whatever order these are stored") {
  Ready one, other;
  for (Ready* it : {&one, &other}) {
    it->sink(1e-3);
    for (std::size_t p = 0; p < it->block().size(); ++p) it->block().v[0][p] = 0.01 * (it->block().id[p] % 7);
    contact_to_grid(it->state, it->grid, 1e-3);
  }
  // The other one is stored upside down now; the slabs that it names hold the same particles, in reverse.
  Body<2>& body = other.block();
  for (std::size_t s = 0; s + 1 < body.slab_begin.size(); ++s) {
    const auto reverse = [&](auto& list) {
      std::reverse(list.begin() + body.slab_begin[s], list.begin() + body.slab_begin[s + 1]);
    };
    for (auto* values : {&body.x[0], &body.x[1], &body.v[0], &body.v[1], &body.mass}) reverse(*values);
    reverse(body.id);
  }
  for (Ready* it : {&one, &other}) contact_to_grid(it->state, it->grid, 1e-3);
  REQUIRE(one.contact().points == other.contact().points);
  CHECK(one.contact().slip == other.contact().slip);
  CHECK(*std::max_element(one.contact().slip.begin(), one.contact().slip.end()) > 0);
}

TEST_CASE("A rigid body that is not there pushes nothing, and what touched it is forgotten") {
  Ready it;
  it.sink(1e-3);
  contact_to_grid(it.state, it.grid, 1e-3);
  CHECK(it.contact().normal_sum > 0);
  it.state.rigid[0].present = false;
  contact_to_grid(it.state, it.grid, 1e-3);
  CHECK(it.contact().normal_sum == 0);
  CHECK(it.contact().points.empty());
}

TEST_CASE("A particle's force does not depend on where it is in its cell, nor on the basis") {
  for (const std::string basis : {"bspline2", "gimp", "linear"}) {
    Ready it({"grid.basis=" + basis});
    it.sink(1e-3);
    contact_to_grid(it.state, it.grid, 1e-3);
    Vec4 sum{};
    for (const Vec4& f : it.grid.force) sum += f;
    CHECK(sum[0] == near(it.contact().normal_force[0] + it.contact().friction_force[0], 1e-10));
  }
}
