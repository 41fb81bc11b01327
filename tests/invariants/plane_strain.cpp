// A scene in space that is the same at every depth between smooth walls is the scene in plane strain.
#include <doctest/doctest.h>
#include <geodrop/measure/measure.hpp>
#include <geodrop/step/pipeline.hpp>

#include <map>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

template <int Dim>
State<Dim> run_steps(const Scene& scene, int steps) {
  State<Dim> state = build_state<Dim>(scene);
  Grids<Dim> grid = make_grids<Dim>(scene);
  Pipeline<Dim> pipeline = build_pipeline<Dim>(scene);
  for (int k = 0; k < steps; ++k) advance(pipeline, state, grid);
  return state;
}

/// Index of each particle by where it began in the plane, in 1e-6 m.
using Places = std::map<std::pair<long long, long long>, std::size_t>;
std::pair<long long, long long> place(double x, double vertical) {
  return {std::llround(x * 1e6), std::llround(vertical * 1e6)};
}

/// Largest differences of a body in space from its like in the plane.
struct Differences {
  double position = 0, velocity = 0, sideways = 0, stress = 0;
};

Differences compare_bodies(const Body<2>& plane, const Body<3>& space) {
  Places places;
  for (std::size_t p = 0; p < plane.size(); ++p)
    places[place(plane.initial_x[0][plane.id[p]], plane.initial_x[1][plane.id[p]])] = p;
  Differences most;
  for (std::size_t q = 0; q < space.size(); ++q) {
    const std::uint32_t id = space.id[q];
    const std::size_t p = places.at(place(space.initial_x[0][id], space.initial_x[2][id]));
    const auto stress_2d = total_stress(plane, p);
    const auto stress_3d = total_stress(space, q);
    most.position =
        std::max({most.position, std::abs(plane.x[0][p] - space.x[0][q]), std::abs(plane.x[1][p] - space.x[2][q])});
    most.velocity =
        std::max({most.velocity, std::abs(plane.v[0][p] - space.v[0][q]), std::abs(plane.v[1][p] - space.v[2][q])});
    most.sideways =
        std::max({most.sideways, std::abs(space.v[1][q]), std::abs(space.x[1][q] - space.initial_x[1][id])});
    // In space XX YY ZZ XY YZ XZ with y along the depth; in the plane XX YY ZZ XY with z along it.
    constexpr int in_plane[] = {0, 2, 1, -1, -1, 3};
    for (int c = 0; c < 6; ++c)
      most.stress = std::max(most.stress, std::abs(stress_3d[c] - (in_plane[c] < 0 ? 0 : stress_2d[in_plane[c]])));
  }
  return most;
}

}  // namespace

TEST_CASE("Sand and water between smooth walls run in space as in plane strain") {
  const std::vector<std::string> same_step{"solver.courant=0.45"};  // the standard in space
  const Scene scene_2d = read_scene(source_path("tests/scenes/run_up.toml"), same_step),
              scene_3d = read_scene(source_path("tests/scenes/run_up_3d.toml"), same_step);
  const State<2> plane = run_steps<2>(scene_2d, 12);
  const State<3> space = run_steps<3>(scene_3d, 12);
  CHECK(space.t == near(plane.t, 1e-12));
  double yielded = 0;
  for (const double strain : plane.bodies[0].deviatoric_strain) yielded = std::max(yielded, strain);
  CHECK(yielded > 0);  // the sand yields, else the comparison would not reach the return map
  for (std::size_t b = 0; b < 2; ++b) {
    CAPTURE(plane.bodies[b].name);
    REQUIRE(space.bodies[b].size() == 6 * plane.bodies[b].size());
    const Differences most = compare_bodies(plane.bodies[b], space.bodies[b]);
    MESSAGE("position ", most.position, " velocity ", most.velocity, " sideways ", most.sideways, " stress ",
            most.stress);
    CHECK(most.position < 1e-10);
    CHECK(most.velocity < 1e-10);  // of about 1 m/s
    CHECK(most.sideways < 1e-10);
    CHECK(most.stress < 1e-10 * 2e4);  // of 20 kPa
  }
  for (int a = 0; a < 2; ++a) CHECK(space.tracers[0].x[2 * a] == near(plane.tracers[0].x[a], 1e-12));
}
