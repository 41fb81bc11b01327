// The same bits for any number of threads.
#include <doctest/doctest.h>

#include "support/program.hpp"

using namespace geodrop::test;

namespace {

/// Runs with 1, 2, 3 and 5 threads; all must end with the same state and the same history.
void check_threads(const std::string& scene, const std::vector<std::string>& settings) {
  SceneRun run(scene, settings, {"--threads", "1"});
  REQUIRE(run.outcome().code == 0);
  const std::string hash = run.hash(), history = geodrop::read_file(run.file("history.csv"));
  REQUIRE(hash.size() == 16);
  for (const std::string threads : {"2", "3", "5"}) {
    CAPTURE(threads);
    CHECK(run.again({"--exact-threads", "--threads", threads}).code == 0);
    CHECK(run.summary().find("\"threads\": " + threads) != std::string::npos);
    CHECK(run.hash() == hash);
    CHECK(geodrop::read_file(run.file("history.csv")) == history);
  }
}

}  // namespace

TEST_CASE("Main case: one hash for 1, 2, 3 and 5 threads") {
  // 0.0766 s are 100 steps at h = 0.5: several sorts, the membrane at work.
  check_threads("cases/dump_kekerdom_mixture.toml", {"grid.spacing=0.5", "time.end=0.0766"});
}

TEST_CASE("Sharp interface: one hash for 1, 2, 3 and 5 threads") {
  check_threads("cases/dump_kekerdom.toml", {"grid.refine=[]", "time.end=0.0766"});
}

TEST_CASE("Main case on the other bases: one hash for 1, 2, 3 and 5 threads") {
  for (const std::string basis : {"gimp", "linear"})
    check_threads("cases/dump_kekerdom_mixture.toml", {"grid.spacing=0.5", "time.end=0.0766", "grid.basis=" + basis});
}

TEST_CASE("Triangles with nodal pressure, MUSL: one hash for 1, 2, 3 and 5 threads") {
  check_threads("cases/sloshing.toml",
                {"grid.basis=tri3", "solver.transfer=musl", "solver.blend_rate=100", "bodies.water.shift=false",
                 "bodies.water.shift_speed=", "bodies.water.pressure=nodal", "grid.spacing=0.015625", "time.end=0.1"});
}

TEST_CASE("Consistent mass matrix, particles shed, MUSL: one hash for 1, 2, 3 and 5 threads") {
  const std::vector<std::string> fine{"grid.spacing=0.015625", "solver.mass_matrix=consistent", "time.end=0.1"};
  check_threads("cases/sloshing.toml", fine);
  std::vector<std::string> musl = fine;
  musl.push_back("solver.transfer=musl");
  check_threads("cases/sloshing.toml", musl);
}

TEST_CASE("Consistent mass beside a sharp membrane: one hash for 1, 2, 3 and 5 threads") {
  check_threads("cases/ellipse_release.toml",
                {"grid.spacing=0.25", "solver.mass_matrix=consistent_at_membranes", "time.end=0.01"});
  check_threads("cases/verification/sphere_release_3d.toml",
                {"grid.spacing=0.5", "solver.mass_matrix=consistent_at_membranes", "time.end=0.002"});
}

TEST_CASE("Shifting water: one hash for 1, 2, 3 and 5 threads") {
  // Finer than the case, so that there are enough particles for threads to be used at all.
  check_threads("cases/hydrostatic_column.toml", {"grid.spacing=0.125", "time.end=0.5"});
}

TEST_CASE("Elastic column: one hash for 1, 2, 3 and 5 threads") {
  check_threads("cases/gravity_column.toml",
                {"grid.spacing=0.0125", "grid.upper.0=0.4", "bodies.column.shape.upper.0=0.4", "time.end=0.02"});
}

TEST_CASE("Periodic walls: one hash for 1, 2, 3 and 5 threads") {
  check_threads("tests/scenes/periodic.toml",
                {"grid.spacing=0.125", "bodies.water.particles_per_cell_axis=3", "time.end=0.2"});
}

TEST_CASE("Sand and water in space: one hash for 1, 2, 3 and 5 threads") {
  // Finer and deeper than the scene: several pencils along y and z, yielding sand, cell pressure, blending.
  check_threads("tests/scenes/run_up_3d.toml",
                {"grid.spacing=0.25", "grid.upper.1=3.0", "bodies.sand.shape.upper.1=3.0",
                 "bodies.water.shape.upper.1=3.0", "bodies.sand.jitter=0.2", "time.end=0.1"});
}

TEST_CASE("The other bases in space: one hash for 1, 2, 3 and 5 threads") {
  const std::vector<std::string> scene{"time.end=0.05", "bodies.water.shift=false", "bodies.water.shift_speed="};
  for (const std::string basis : {"gimp", "linear", "tet4"}) {
    CAPTURE(basis);
    std::vector<std::string> settings = scene;
    settings.push_back("grid.basis=" + basis);
    if (basis == "tet4")
      for (const std::string more : {"solver.transfer=musl", "bodies.water.pressure=nodal"}) settings.push_back(more);
    if (basis == "tet4") settings.push_back("solver.blend_rate=100");
    check_threads("cases/hydrostatic_column_3d.toml", settings);
  }
}

TEST_CASE("Shifting water in space: one hash for 1, 2, 3 and 5 threads") {
  check_threads("cases/hydrostatic_column_3d.toml", {"time.end=0.1"});
}

TEST_CASE("Water in the pores of a soil, pumped: one hash for 1, 2, 3 and 5 threads") {
  check_threads("cases/verification/quick_condition.toml",
                {"grid.upper.0=1.6", "bodies.base.shape.upper.0=1.6", "bodies.soil.shape.upper.0=1.6",
                 "bodies.feed.shape.upper.0=1.6", "bodies.pore_water.shape.upper.0=1.6",
                 "bodies.free_water.shape.upper.0=1.6", "bodies.soil.jitter=0.3", "time.end=0.02"});
}

TEST_CASE("Soil with a critical porosity that collapses in oil, drag of Forchheimer: one hash") {
  check_threads("cases/verification/submerged_column_loose.toml",
                {"grid.spacing=0.003", "bodies.column.jitter=0.2", "materials.beads.forchheimer_coefficient=1e3",
                 "time.end=0.02"});
}

TEST_CASE("Graded axes: one hash for 1, 2, 3 and 5 threads") {
  check_threads("cases/dump_kekerdom_mixture.toml",
                {"grid.spacing=0.5", "time.end=0.05",
                 "grid.refine=[{axis='x',from=-1.5,to=1.5,spacing=0.25},{axis='y',from=5.0,to=13.0,spacing=0.25}]"});
}

TEST_CASE("Graded axes in space: one hash for 1, 2, 3 and 5 threads") {
  check_threads("cases/hydrostatic_column_3d.toml", {"time.end=0.1",
                                                     "grid.refine=[{axis='y',from=0.5,to=0.7,spacing=0.0625},"
                                                     "{axis='z',from=1.8,to=2.1,spacing=0.07,growth=1.3}]"});
}

TEST_CASE("Bare and skinned blocks between rigid bodies that move: one hash for 1, 2, 3 and 5 threads") {
  // Finer than the scene: enough particles for threads to be used.
  check_threads("tests/scenes/ramp.toml", {"grid.spacing=0.03125", "time.end=0.15"});
}

TEST_CASE("Sharp interface in space: one hash for 1, 2, 3 and 5 threads") {
  // Fine enough for threads to be used in the blocks of the grid and in the solution.
  check_threads("cases/verification/sphere_release_3d.toml", {"time.end=0.002"});
}

TEST_CASE("Tube on the ground, enclosed, pumped up, with contact and relaxation: one hash for 1, 2, 3 and 5 threads") {
  check_threads("tests/scenes/tube.toml", {"time.end=0.25"});
}

TEST_CASE("Ground on a viscous boundary, and sand with open voids: one hash for 1, 2, 3 and 5 threads") {
  check_threads("tests/scenes/viscous_bed.toml", {"grid.spacing=0.125", "bodies.bed.jitter=0.3", "time.end=0.05"});
  check_threads("tests/scenes/thrown_sand.toml", {"grid.spacing=0.0625", "bodies.column.jitter=0.3", "time.end=0.3"});
}

TEST_CASE("Two velocity fields, contact, stages with damping: one hash for 1, 2, 3 and 5 threads") {
  // The block comes in after a third of the time and rubs on a slab that still moves.
  check_threads("tests/scenes/block_on_slab.toml",
                {"grid.spacing=0.0625", "time.end=0.06",
                 "stages=[{name='slab',from=0.0,damping_rate=4.0},"
                 "{name='both',from=0.02,places=['block'],damping_rate=6.0,damping_ramp=0.03}]",
                 "probes=[{name='cut',type='section',body='block',x=2.0}]"});
}
