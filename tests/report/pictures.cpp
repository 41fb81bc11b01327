// Pictures of frames: pixels of particles, colours, numbers with few digits, frames read back.
#include "files/frame_writer.hpp"
#include "files/read_frames.hpp"
#include "report/picture_page.hpp"
#include "report/picture_pixels.hpp"
#include "report/picture_values.hpp"
#include "report/raster.hpp"
#include "support/near.hpp"
#include "support/program.hpp"
#include "support/scene_files.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>
#include <geodrop/base/error.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr Colour red{255, 0, 0}, blue{0, 0, 255};

/// Opaque pixels of a colour.
int count(const std::string& pixels, Colour colour) {
  int number = 0;
  for (std::size_t i = 0; i < pixels.size(); i += 4)
    number +=
        pixels[i + 3] != 0 && Colour{static_cast<std::uint8_t>(pixels[i]), static_cast<std::uint8_t>(pixels[i + 1]),
                                     static_cast<std::uint8_t>(pixels[i + 2])} == colour
            ? 1
            : 0;
  return number;
}

}  // namespace

TEST_CASE("A disc covers its area, and of two that overlap each has the half that is nearer") {
  const Window window{{0, 0}, {10, 10}};
  const std::string one = draw_discs({{{5, 5}, 2, red}}, window, {100, 100});
  CHECK(count(one, red) == near(100 * std::numbers::pi * 4, 0.02));
  const std::string two = draw_discs({{{4, 5}, 3, red}, {{6, 5}, 3, blue}}, window, {100, 100});
  CHECK(count(two, red) == count(two, blue));
  const std::string lower_left = draw_discs({{{0, 0}, 2, red}}, window, {100, 100});
  CHECK(count(lower_left, red) == near(100 * std::numbers::pi, 0.03));
  CHECK(lower_left[3] != 0);  // the lowest row comes first
}

TEST_CASE("A window far smaller than a particle, and far from it") {
  for (const double width : {1e-8, 1e-12}) {
    const Window window{{0, 0}, {width, width}};
    CHECK(count(draw_discs({{{5, 5}, 2, red}}, window, {100, 100}), red) == 0);
    CHECK(count(draw_discs({{{0, 0}, 2, red}}, window, {100, 100}), red) == 100 * 100);
  }
}

TEST_CASE("Narrow gaps between rows of particles are closed, what is outside is not covered") {
  std::vector<Disc> rows;
  for (int i = 0; i <= 10; ++i)
    for (const double y : {4.0, 6.0}) rows.push_back({{static_cast<double>(i), y}, 0.7, red});
  const std::string pixels = draw_discs(rows, {{0, 0}, {10, 10}}, {100, 100});
  const auto opaque = [&](double x, double y) {
    return pixels[4 * (static_cast<std::size_t>(y * 10) * 100 + static_cast<std::size_t>(x * 10)) + 3] != 0;
  };
  CHECK(opaque(5, 5));        // between them
  CHECK_FALSE(opaque(5, 3));  // below: nearer than the gap is wide
  CHECK_FALSE(opaque(5, 7.1));
}

TEST_CASE("A particle in a closed line is seen inside only, one that has got out as it is") {
  const Window window{{0, 0}, {10, 10}};
  const PixelSize size{100, 100};
  const Mask square = inside_of({{{2, 2, 6, 2}}, {{6, 6, 6, 2}}, {{6, 6, 2, 6}}, {{2, 6, 2, 2}}}, window, size);
  CHECK(std::ranges::count(square, true) == 40 * 40);
  CHECK(square[30 * 100 + 30]);
  CHECK_FALSE(square[30 * 100 + 70]);
  const std::string kept = draw_discs({{{5.95, 4}, 1, red, &square}}, window, size);
  CHECK(count(kept, red) == near(100 * std::numbers::pi / 2, 0.06));
  const std::string out = draw_discs({{{7, 4}, 1, red, &square}}, window, size);
  CHECK(count(out, red) == near(100 * std::numbers::pi, 0.04));
}

TEST_CASE("What a closed line fills ends at the window, wherever its corners are") {
  const Window window{{0, 0}, {10, 10}};
  const PixelSize size{100, 100};
  std::string pixels = draw_discs({{{5, 9.5}, 0.5, red}}, window, size);
  // Everything below the diagonal from the lower left corner to the upper right one.
  fill(pixels, inside_of({{{-20, -20, 30, 30}}, {{30, 30, 30, -20}}, {{30, -20, -20, -20}}}, window, size), blue);
  CHECK(count(pixels, blue) == near(100 * 100 / 2, 0.011));
  CHECK(pixels[4 * 99 + 3] != 0);                                  // lower right
  CHECK(pixels[4 * static_cast<std::size_t>(99 * 100) + 3] == 0);  // upper left
  CHECK(count(pixels, red) == near(100 * std::numbers::pi / 4, 0.1));
}

TEST_CASE("Scales of colours: their ends, their middle, and grey for no number") {
  CHECK(colour_at(ColourScale::viridis, 0) == Colour{68, 1, 84});
  CHECK(colour_at(ColourScale::viridis, 2) == Colour{253, 231, 37});
  CHECK(colour_at(ColourScale::difference, 0.5) == Colour{221, 221, 221});
  CHECK(colour_at(ColourScale::viridis, std::nan("")) == Colour{160, 160, 160});
  CHECK(rgb({1, 2, 3}) == 0x010203U);
}

TEST_CASE("Soil in a membrane and soil around it differ in colour, layer by layer, also where both are one material") {
  Scene scene;
  scene.materials = {{"sand", MohrCoulombSpec{}, {}}};
  for (const char* name : {"bed", "bag"}) {
    BodySpec body;
    body.name = name;
    body.material = "sand";
    body.layers = 2;
    scene.bodies.push_back(body);
  }
  MembraneSpec membrane;
  membrane.body = "bag";
  membrane.axial_stiffness = 1;
  scene.membranes.push_back(membrane);
  membrane.body = "bed";  // a skin makes no fill of a bed
  membrane.axial_stiffness = 0;
  scene.membranes.push_back(membrane);
  ParticleSnapshot particles;
  particles.body = {0, 0, 1, 1};
  particles.material = {0, 0, 0, 0};
  particles.layer = {0, 1, 0, 1};
  const Categories layers = layers_of(scene, particles);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(layers.colours[i] == layers.colours[j]);
  REQUIRE(layers.legend.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(layers.legend[i].colour == layers.colours[i]);
}

TEST_CASE("Water around a bag is not seen inside its membrane, where its particles are nearer; a stray is") {
  Scene scene;
  scene.dimension = 2;
  scene.grid.spacing = 4;  // discs of 1.4 m
  for (const char* name : {"water", "bag"}) {
    BodySpec body;
    body.name = name;
    scene.bodies.push_back(body);
  }
  MembraneSpec membrane;
  membrane.body = "bag";
  scene.membranes.push_back(membrane);
  PaintedView painted;
  Snapshot& frame = painted.view.frame;
  frame.membranes.points = {2, 2, 0, 6, 2, 0, 6, 6, 0, 2, 6, 0};
  frame.membranes.connectivity = {0, 1, 1, 2, 2, 3, 3, 0};
  frame.membranes.membrane = {0, 0, 0, 0};
  frame.particles.points = {6.2, 4, 0, 5, 4, 0, 3, 3, 0};
  frame.particles.body = {0, 1, 0};
  painted.colours = {blue, red, blue};
  const std::string pixels = pixels_of(scene, painted, {{{0, 0}, {10, 10}}, {100, 100}, 0});
  const auto is_of = [&](double x, double y, Colour colour) {
    const std::size_t at = 4 * (static_cast<std::size_t>(y * 10) * 100 + static_cast<std::size_t>(x * 10));
    return count(pixels.substr(at, 4), colour) == 1;
  };
  CHECK(is_of(5.9, 4, red));   // the water is nearer
  CHECK(is_of(6.1, 4, blue));  // beyond the membrane the bag is not seen
  CHECK(is_of(3, 3, blue));    // water that got in
}

TEST_CASE("A title too long for its view begins at its left edge, one too long for the picture goes on below") {
  const Panel panel{{}, {400, 600}, 80};
  PictureLayout layout{{panel}, 900, 700};
  CHECK(contains(title_text("Sand, t = 2.00 s", panel, layout), "set title 'Sand, t = 2.00 s'"));
  const std::string longer = title_text(std::string(70, 'a') + ", t = 2.00 s", panel, layout);
  CHECK(contains(longer, "set label '" + std::string(70, 'a') + ", t = 2.00 s' left at screen"));
  const std::string two_lines = title_text(std::string(80, 'a') + ", t = 2.00 s", panel, layout);
  CHECK(contains(two_lines, "a,'.\"\\n\".'t = 2.00 s'"));
}

TEST_CASE("Values of fields by their names: lengths of vectors, components, numbers") {
  const std::vector<Field> fields{{"velocity", {"X", "Y", "Z"}, {3, 4, 0, 0, -2, 0}}, {"density", {}, {1000, 1600}}};
  CHECK(value_names(fields) ==
        std::vector<std::string>{"velocity", "velocity_x", "velocity_y", "velocity_z", "density"});
  CHECK(values_of(fields, "velocity").values == std::vector<double>{5, 2});
  CHECK(values_of(fields, "velocity_y").values == std::vector<double>{4, -2});
  CHECK(values_of(fields, "velocity_y").unit == "m/s");
  CHECK(values_of(fields, "density").values == std::vector<double>{1000, 1600});
  CHECK(values_of({{"cross_tension", {}, {1}}}, "cross_tension").unit == "N/m");
}

TEST_CASE("A frame is read as it was written") {
  Snapshot written;
  written.t = 1.5;
  written.particles.points = {1, 2, 0, 3, 4, 0};
  written.particles.fields = {{"velocity", {"X", "Y", "Z"}, {1, 2, 3, 4, 5, 6}}, {"density", {}, {7, 8}}};
  written.particles.layer = {0, 3};
  written.particles.material = {1, 0};
  written.particles.body = {0, 1};
  written.particles.id = {9, 10};
  written.membranes.points = {0, 0, 0, 1, 0, 0, 1, 1, 0};
  written.membranes.connectivity = {0, 1, 1, 2};
  written.membranes.fields = {{"tension", {}, {11, 12}}};
  written.membranes.membrane = {0, 0};
  const TemporaryDirectory directory;
  FrameWriter writer(directory / "", Compression::none, {});
  writer.submit(written);
  writer.wait();
  REQUIRE(writer.failure().empty());
  CHECK(frame_times(directory / "") == std::vector<double>{1.5});
  const Snapshot read = read_frame(directory / "", 0);
  CHECK(read.t == 1.5);
  CHECK(read.particles.points == written.particles.points);
  REQUIRE(read.particles.fields.size() == 2);
  CHECK(read.particles.fields[0].components == written.particles.fields[0].components);
  CHECK(read.particles.fields[0].values == written.particles.fields[0].values);
  CHECK(read.particles.layer == written.particles.layer);
  CHECK(read.particles.material == written.particles.material);
  CHECK(read.particles.body == written.particles.body);
  CHECK(read.membranes.connectivity == written.membranes.connectivity);
  CHECK(read.membranes.fields.at(0).values == written.membranes.fields[0].values);
  std::ofstream(directory / "particles_000000.vtu") << "<VTKFile";
  CHECK_THROWS_AS(read_frame(directory / "", 0), SceneError);
  CHECK(frame_near({0, 1, 2}, 1.4) == 1);
}

TEST_CASE("snapshot and animate draw a run; what they cannot draw is named") {
  const SceneRun run("cases/dump_kekerdom_mixture.toml", {"grid.spacing=0.5", "time.end=0.2"});
  REQUIRE(run.outcome().code == 0);
  const std::string directory = run.file("").string();
  const Outcome drawn = run_program({"snapshot", directory, "--time", "0.1", "--field", "velocity"});
  CAPTURE(drawn.err);
  CHECK(drawn.code == 0);
  CHECK(contains(drawn.out, "snapshot_velocity_0.10_s.png"));
  const std::string png = read_file(run.file("snapshot_velocity_0.10_s.png"));
  CHECK(png.starts_with("\x89PNG"));
  REQUIRE(run_program(
              {"snapshot", directory, "--time", "0.1", "--window=-3,3,5,13", "--output", run.file("part.png").string()})
              .code == 0);
  CHECK(read_file(run.file("part.png")) != png);
  const Outcome field = run_program({"snapshot", directory, "--field", "velocty"});
  CHECK(field.code == 2);
  CHECK(contains(field.err, "the nearest is \"velocity\""));
  CHECK(run_program({"snapshot", directory, "--window=3,-3,5,13"}).code == 2);
  CHECK(run_program({"snapshot", directory, "--window=-3,3,-3,3,5,13"}).code == 2);
  CHECK(contains(run_program({"snapshot", directory, "--cut=0,0"}).err, "--cut: found a scene of the plane"));
  CHECK(run_program({"snapshot", directory + "/none"}).code == 2);
  CHECK(run_program({"animate", directory}).code == 0);
  CHECK(read_file(run.file("animation.gif")).starts_with("GIF89a"));
}

TEST_CASE("Water in the pores of a bag is not drawn over its soil; water that is elsewhere, too, is drawn") {
  const Scene bag = read_scene(source_path("cases/dump_kekerdom.toml"));
  for (const BodySpec& body : bag.bodies) CHECK(lies_in_pores(bag, body) == (body.name == "pore_water"));
  for (const LegendEntry& entry : layers_of(bag, {}).legend) CHECK(entry.name.find("pore_water") == std::string::npos);
  const Scene bed = read_scene(source_path("cases/verification/saturated_bed_rests.toml"));
  for (const BodySpec& body : bed.bodies) CHECK_FALSE(lies_in_pores(bed, body));
}
