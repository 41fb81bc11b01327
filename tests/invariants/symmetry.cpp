// What must not matter: the order of the bodies in the scene, which side is left, where the origin is.
#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include <map>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// The main case, coarse, with the container tilted and aside so that nothing is symmetric by itself.
Scene tilted_scene(double side) {
  return read_scene(source_path("cases/dump_kekerdom_mixture.toml"),
                    {"grid.spacing=0.5", "bodies.container.shape.tilt_deg=" + std::to_string(20 * side),
                     "bodies.container.shape.centre=[" + std::to_string(3 * side) + ", 9.0]"});
}

State<2> run_steps(const Scene& scene, int steps) {
  State<2> state = build_state<2>(scene);
  Grids<2> grid = make_grids<2>(scene);
  Pipeline<2> pipeline = build_pipeline<2>(scene);
  for (int k = 0; k < steps; ++k) advance(pipeline, state, grid);
  return state;
}

const Body<2>& body_named(const State<2>& state, const std::string& name) {
  for (const Body<2>& body : state.bodies)
    if (body.name == name) return body;
  throw std::runtime_error("no body " + name);
}

/// Index of the particle with each id.
std::vector<std::size_t> by_id(const Body<2>& body) {
  std::vector<std::size_t> index(body.size());
  for (std::size_t p = 0; p < body.size(); ++p) index[body.id[p]] = p;
  return index;
}

}  // namespace

TEST_CASE("The order of the bodies in the scene changes nothing beyond round-off") {
  const Scene scene = tilted_scene(1);
  Scene reversed = scene;
  std::reverse(reversed.bodies.begin(), reversed.bodies.end());
  const State<2> one = run_steps(scene, 60), two = run_steps(reversed, 60);
  CHECK(one.t == near(two.t, 1e-12));
  for (const std::string name : {"water", "bed", "container"}) {
    CAPTURE(name);
    const Body<2>&a = body_named(one, name), &b = body_named(two, name);
    REQUIRE(a.size() == b.size());
    const auto in_a = by_id(a), in_b = by_id(b);
    double apart = 0, faster = 0;
    for (std::size_t id = 0; id < a.size(); ++id)
      for (int c = 0; c < 2; ++c) {
        apart = std::max(apart, std::abs(a.x[c][in_a[id]] - b.x[c][in_b[id]]));
        faster = std::max(faster, std::abs(a.v[c][in_a[id]] - b.v[c][in_b[id]]));
      }
    CHECK(apart < 1e-9);   // of 30 m
    CHECK(faster < 1e-7);  // of about 1 m/s; round-off grows with the pressures of 1e5 Pa behind it
  }
}

TEST_CASE("The mirror image of a scene runs as the mirror image") {
  const State<2> right = run_steps(tilted_scene(1), 60), left = run_steps(tilted_scene(-1), 60);
  for (const std::string name : {"water", "bed", "container"}) {
    CAPTURE(name);
    const Body<2>&a = body_named(right, name), &b = body_named(left, name);
    REQUIRE(a.size() == b.size());
    // Particles are identified by where they began: to 1e-6 m, mirrored.
    const auto key = [](double x, double y) { return std::pair(std::llround(x * 1e6), std::llround(y * 1e6)); };
    std::map<std::pair<long long, long long>, std::size_t> images;
    for (std::size_t p = 0; p < b.size(); ++p) images[key(-b.initial_x[0][b.id[p]], b.initial_x[1][b.id[p]])] = p;
    double apart = 0, faster = 0;
    std::size_t matched = 0;
    for (std::size_t p = 0; p < a.size(); ++p) {
      const auto found = images.find(key(a.initial_x[0][a.id[p]], a.initial_x[1][a.id[p]]));
      if (found == images.end()) continue;  // rounded to the other side
      const std::size_t q = found->second;
      ++matched;
      apart = std::max({apart, std::abs(a.x[0][p] + b.x[0][q]), std::abs(a.x[1][p] - b.x[1][q])});
      faster = std::max({faster, std::abs(a.v[0][p] + b.v[0][q]), std::abs(a.v[1][p] - b.v[1][q])});
    }
    CHECK(matched > 0.99 * static_cast<double>(a.size()));
    CHECK(apart < 1e-8);
    CHECK(faster < 1e-6);
  }
}
