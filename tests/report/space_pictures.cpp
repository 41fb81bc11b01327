// Pictures of scenes in space: what is seen from the side and from the front, and what a cut shows.
#include "files/read_frames.hpp"
#include "geometry/surface_ends.hpp"
#include "geometry/surface_generators.hpp"
#include "report/frame_cut.hpp"
#include "report/picture_content.hpp"
#include "report/picture_page.hpp"
#include "report/picture_pixels.hpp"
#include "support/near.hpp"
#include "support/program.hpp"
#include "support/scene_files.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr Colour red{255, 0, 0}, blue{0, 0, 255}, nothing{0, 0, 0};

Colour colour_of(const std::string& pixels, PixelSize size, int i, int j) {
  const std::size_t at =
      4 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(i));
  const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(pixels.at(at + k)); };
  return byte(3) == 0 ? nothing : Colour{byte(0), byte(1), byte(2)};
}

/// Two triangles across z of the plane, from 0 to 10 m.
std::vector<Facet> square(double z, Colour colour) {
  return {{{{{0, 0, z}, {10, 0, z}, {10, 10, z}}}, colour}, {{{{0, 0, z}, {10, 10, z}, {0, 10, z}}}, colour}};
}

std::vector<Facet> joined(std::vector<Facet> first, const std::vector<Facet>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

MembraneSnapshot membrane_of(const TriangleSurface& surface) {
  MembraneSnapshot membrane;
  membrane.corners = 3;
  for (const Corner& x : surface.points) membrane.points.insert(membrane.points.end(), x.begin(), x.end());
  for (const auto& t : surface.triangles) membrane.connectivity.insert(membrane.connectivity.end(), t.begin(), t.end());
  membrane.membrane.assign(surface.triangles.size(), 0);
  membrane.fields = {{"tension", {}, std::vector<float>(surface.triangles.size(), 0)}};
  return membrane;
}

Scene scene_in_space() {
  Scene scene;
  scene.dimension = 3;
  scene.grid.lower = {-3, -2, -1};
  scene.grid.upper = {3, 2, 4};
  scene.grid.spacing = 0.5;
  scene.title = "In space";
  return scene;
}

/// A ball of radius 1 whose tension tells where it faces: 1 kN/m the viewer of the side, 2 of the front, 0 anything
/// else.
Snapshot ball() {
  const TriangleSurface surface = ellipsoid_surface({0, 0, 0}, {1, 1, 1}, 0.1);
  Snapshot frame;
  frame.membranes = membrane_of(surface);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    Corner middle{};
    for (const std::uint32_t corner : surface.triangles[t])
      for (std::size_t a = 0; a < 3; ++a) middle[a] += surface.points[corner][a] / 3;
    frame.membranes.fields[0].values[t] = middle[1] < -0.8 ? 1e3F : middle[0] > 0.8 ? 2e3F : 0.0F;
  }
  return frame;
}

/// |x| + |y| + |z| = 1
TriangleSurface octahedron() {
  TriangleSurface surface;
  surface.points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t k = 0; k < 4; ++k) {
    surface.triangles.push_back({k, (k + 1) % 4, 4});
    surface.triangles.push_back({(k + 1) % 4, k, 5});
  }
  return surface;
}

void check_closed(const MembraneSnapshot& lines) {
  std::map<std::uint32_t, int> ends;
  for (const std::uint32_t node : lines.connectivity) ++ends[node];
  CHECK(ends.size() == lines.points.size() / 3);
  CHECK(std::ranges::all_of(ends, [](const auto& end) { return end.second == 2; }));
}

double length_of(const MembraneSnapshot& lines) {
  double length = 0;
  for (std::size_t s = 0; s < lines.connectivity.size(); s += 2) {
    const double *from = &lines.points[3 * lines.connectivity[s]], *to = &lines.points[3 * lines.connectivity[s + 1]];
    length += std::hypot(from[0] - to[0], from[1] - to[1], from[2] - to[2]);
  }
  return length;
}

}  // namespace

TEST_CASE("Of two triangles over one another the nearer one is seen, whichever is drawn last") {
  const Window window{{0, 0}, {10, 10}};
  const PixelSize size{100, 100};
  for (const auto& facets : {joined(square(2, red), square(1, blue)), joined(square(1, blue), square(2, red))}) {
    const std::string pixels = draw_facets(facets, window, size);
    for (int i = 0; i < 100; ++i)
      for (int j = 0; j < 100; ++j) REQUIRE(colour_of(pixels, size, i, j) == red);  // no gap on the diagonal
  }
  // One that leans through the other: nearer on the right of x = 4.
  const Facet leaning{{{{0, 0, -4}, {10, 0, 6}, {10, 10, 6}}}, blue};
  const std::string pixels = draw_facets(joined(square(0, red), {leaning}), window, size);
  CHECK(colour_of(pixels, size, 38, 2) == red);
  CHECK(colour_of(pixels, size, 42, 2) == blue);
  CHECK(colour_of(pixels, size, 42, 60) == red);  // beside it
}

TEST_CASE("A triangle covers its area and nothing beyond the window") {
  const Window window{{5, 0}, {15, 10}};
  const std::string pixels = draw_facets(square(0, red), window, {100, 100});
  CHECK(colour_of(pixels, {100, 100}, 49, 99) == red);
  CHECK(colour_of(pixels, {100, 100}, 50, 0) == nothing);
  const std::string edge_on = draw_facets({{{{{6, 0, 0}, {6, 5, 1}, {6, 10, 0}}}, blue}}, window, {100, 100});
  CHECK(std::ranges::count(edge_on, '\0') == 4 * 100 * 100);
}

TEST_CASE("A membrane is seen from -y on the left and from +x on the right, in the colours of its nearest triangles") {
  const Scene scene = scene_in_space();
  const Snapshot frame = ball();
  const PictureContent content = content_of(scene, frame, {"tension", "tension", {}, ValueRange{0, 2e3}, {}, {}});
  const PictureLayout layout = layout_of(whole_extent(scene, frame), content);
  REQUIRE(content.views.size() == 2);
  REQUIRE(content.field.has_value());
  CHECK_FALSE(content.membrane.has_value());
  CHECK(content.field->unit.unit == "kN/m");
  for (const std::size_t v : {0U, 1U}) {
    const Panel& panel = layout.panels[v];
    const std::string pixels = pixels_of(scene, content.views[v], panel);
    const auto seen_at = [&](double x, double z) {
      const double metre = panel.pixels.width / panel.window.width();
      return colour_of(pixels, panel.pixels, static_cast<int>((x - panel.window.lower[0]) * metre),
                       static_cast<int>((z - panel.window.lower[1]) * metre));
    };
    CHECK(seen_at(0, 0) == content.field->colour(v == 0 ? 1e3 : 2e3));
    CHECK(seen_at(0, 0.9) == content.field->colour(0));
    // The edge of the other field: +x on the right of the side view, -y on the left of the front view.
    CHECK(seen_at(v == 0 ? 0.97 : -0.97, 0) == content.field->colour(v == 0 ? 2e3 : 1e3));
    CHECK(seen_at(v == 0 ? -0.97 : 0.97, 0) == content.field->colour(0));
    CHECK(seen_at(1.1, 0) == nothing);
  }
}

TEST_CASE("Both views have one scale and the same heights, also where the domain is narrow") {
  for (const double width : {4.0, 0.2}) {
    Scene scene = scene_in_space();
    scene.grid.lower[1] = -width / 2;
    scene.grid.upper[1] = width / 2;
    const PictureContent content = content_of(scene, {}, {"layers", "none", {}, {}, {}, {}});
    const PictureLayout layout = layout_of(whole_extent(scene, {}), content);
    const Panel &side = layout.panels.at(0), &front = layout.panels.at(1);
    const double metre = side.pixels.width / side.window.width();
    CHECK(side.pixels.height / side.window.height() == near(metre, 1e-9));
    CHECK(front.pixels.width / front.window.width() == near(metre, 1e-9));
    CHECK(front.window.lower[1] == side.window.lower[1]);
    CHECK(front.window.upper[1] == side.window.upper[1]);
    CHECK(side.window.lower[0] <= -3);
    CHECK(side.window.upper[1] >= 4);
    CHECK(front.left > side.left + side.pixels.width);
    CHECK(layout.width >= front.left + front.pixels.width);
  }
}

TEST_CASE(
    "The lines in which a plane cuts a membrane close, also through its corners; their values are the triangles'") {
  Snapshot frame = ball();
  const auto triangles = static_cast<float>(frame.membranes.membrane.size());
  for (float t = 0; t < triangles; ++t) frame.membranes.fields[0].values[static_cast<std::size_t>(t)] = t;
  for (const double place : {0.0, 0.3, -0.61}) {
    const MembraneSnapshot lines = cut_frame(frame, {2, place}, 0.25).membranes;
    CHECK(lines.corners == 2);
    check_closed(lines);
    // Edges of 0.1 m: an inscribed polygon is shorter by (0.1 / 2)^2 / 6 or so.
    CHECK(length_of(lines) == near(2 * std::numbers::pi * std::sqrt(1 - place * place), 3e-3));
    for (std::size_t i = 2; i < lines.points.size(); i += 3) CHECK(std::abs(lines.points[i] - place) < 1e-12);
    REQUIRE(lines.fields.at(0).values.size() == lines.membrane.size());
    for (std::size_t s = 0; s < lines.membrane.size(); ++s) {
      const auto t = static_cast<std::size_t>(lines.fields[0].values[s]);
      double low = 1, high = -1;
      for (std::size_t k = 0; k < 3; ++k) {
        const double z = frame.membranes.points[3 * frame.membranes.connectivity[3 * t + k] + 2];
        low = std::min(low, z);
        high = std::max(high, z);
      }
      CHECK(low <= place);
      CHECK(high >= place);
    }
  }
  frame.membranes = membrane_of(octahedron());
  const MembraneSnapshot square = cut_frame(frame, {1, 0}, 0.25).membranes;  // the plane of four corners
  check_closed(square);
  CHECK(length_of(square) == near(4 * std::numbers::sqrt2, 1e-12));
}

TEST_CASE("A cut shows the particles near its plane, and none that a membrane parts from it") {
  Snapshot frame;
  frame.membranes = membrane_of(octahedron());
  // Inside at the plane y = 0; outside, before a face that leans over the plane's inside; outside; too far off.
  frame.particles.points = {0.5, 0.2, 0, 0.9, 0.2, 0, 1.2, 0.2, 0, 0.5, 0.3, 0, 0.1, -0.25, 0.1};
  frame.particles.id = {0, 1, 2, 3, 4};
  frame.particles.fields = {{"velocity", {"X", "Y", "Z"}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14}}};
  const ParticleSnapshot shown = cut_frame(frame, {1, 0}, 0.25).particles;
  CHECK(shown.id == std::vector<std::uint32_t>{0, 2, 4});
  CHECK(shown.fields.at(0).values == std::vector<float>{0, 1, 2, 6, 7, 8, 12, 13, 14});
  CHECK(shown.points == std::vector<double>{0.5, 0.2, 0, 1.2, 0.2, 0, 0.1, -0.25, 0.1});
}

TEST_CASE(
    "A membrane that ends at a plane of symmetry is cut there as the whole one would be, and is the middle of a view") {
  Snapshot frame;
  frame.membranes = membrane_of(cut_off(octahedron(), {1, false, 0}, 0));
  frame.particles.points = {0.5, 0.2, 0, 0.9, 0.2, 0, 1.2, 0.2, 0};
  frame.particles.id = {0, 1, 2};
  const Snapshot half = cut_frame(frame, {1, 0}, 0.25);
  check_closed(half.membranes);
  CHECK(length_of(half.membranes) == near(4 * std::numbers::sqrt2, 1e-5));
  CHECK(half.particles.id == std::vector<std::uint32_t>{0, 2});
  frame.membranes = membrane_of(cut_off(octahedron(), {0, true, 0}, 0));  // lines along x leave it by the wall
  frame.particles.points = {-0.5, 0.2, 0, -0.9, 0.2, 0, -1.2, 0.2, 0};
  CHECK(cut_frame(frame, {1, 0}, 0.25).particles.id == std::vector<std::uint32_t>{0, 2});
  Scene scene = scene_in_space();
  scene.membranes.resize(1);
  scene.membranes[0].drawn.ends = {{0, true, 0}};
  CHECK(views_of(scene, frame, Sight::cut, {}).at(1).title == "front view, cut at x = 0 m");
}

TEST_CASE("Views are cut in the middle of the membranes or where they are asked to be, half a cell to either side") {
  Scene scene = scene_in_space();
  Snapshot frame;
  TriangleSurface surface = octahedron();
  for (Corner& x : surface.points) x[0] += 1.5;
  frame.membranes = membrane_of(surface);
  frame.particles.points = {-2, 0.24, 0, 1.5, -1.9, 0.5, -2.2, 1.1, 3, -2.5, -0.26, 0};
  frame.particles.id = {0, 1, 2, 3};
  const std::vector<View> middle = views_of(scene, frame, Sight::cut, {});
  CHECK(middle.at(0).title == "side view, cut at y = 0 m");
  CHECK(middle.at(1).title == "front view, cut at x = 1.5 m");
  CHECK(middle[0].frame.particles.points == std::vector<double>{-2, 0, -0.24});  // towards the viewer: -y
  CHECK(middle[1].frame.particles.points == std::vector<double>{-1.9, 0.5, 1.5});
  const std::vector<View> asked = views_of(scene, frame, Sight::cut, std::array{-2.1, 0.9});
  CHECK(asked[0].frame.particles.id == std::vector<std::uint32_t>{2});
  CHECK(asked[1].frame.particles.id == std::vector<std::uint32_t>{0, 2});
  CHECK(asked[0].frame.membranes.membrane.size() == 4);  // at the corner y = 1
}

TEST_CASE("Half-spaces at rest are lines where they are seen edge on, until a stage takes them away") {
  Scene scene = scene_in_space();
  RigidSpec wall;
  wall.name = "quay";
  wall.shape = HalfPlaneShape{{-2, 0, 0}, {1, 0, 0}};
  scene.rigid.push_back(wall);
  StageSpec stage;
  stage.from = 1;
  stage.removes = {"quay"};
  scene.stages.push_back(stage);
  Snapshot frame;
  const std::vector<View> before = views_of(scene, frame, Sight::cut, {});
  REQUIRE(before[0].frame.rigid.points.size() == 6);
  CHECK(before[0].frame.rigid.points[0] == -2);
  CHECK(before[0].frame.rigid.points[3] == -2);
  CHECK(before[1].frame.rigid.points.empty());  // seen from ahead
  frame.t = 1;
  CHECK(views_of(scene, frame, Sight::cut, {})[0].frame.rigid.points.empty());
}

TEST_CASE("snapshot, animate and report draw a run in space; what does not fit it is refused") {
  const SceneRun run("tests/scenes/trough_3d.toml");
  REQUIRE(run.outcome().code == 0);
  const std::string directory = run.file("").string();
  const Snapshot frame = read_frame(directory, 1);
  CHECK(frame.membranes.corners == 3);
  CHECK(frame.membranes.connectivity.size() == 3 * frame.membranes.membrane.size());
  CHECK(frame.membranes.fields.at(0).values.size() == frame.membranes.membrane.size());
  const Outcome alone = run_program({"snapshot", directory, "--time", "0.4"});
  CAPTURE(alone.err);
  REQUIRE(alone.code == 0);
  CHECK(contains(alone.out, "snapshot_tension_0.40_s.png"));  // there are no particles
  const std::string outside = read_file(run.file("snapshot_tension_0.40_s.png"));
  CHECK(outside.starts_with("\x89PNG"));
  const auto drawn = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words{"snapshot", directory, "--time", "0.4", "--output", run.file("drawn.png").string()};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = run_program(words);
    CHECK_MESSAGE(outcome.code == 0, outcome.err);
    return read_file(run.file("drawn.png"));
  };
  const std::string cut = drawn({"--field", "layers"});
  CHECK(cut != outside);
  CHECK(drawn({"--field", "layers", "--cut=0.4,0.1"}) != cut);
  CHECK(drawn({"--field", "utilisation"}) != outside);
  CHECK(drawn({"--window=-1,1,-1,1,0,1"}) != outside);
  const Outcome window = run_program({"snapshot", directory, "--window=-1,1,0,1"});
  CHECK(window.code == 2);
  CHECK(contains(window.err, "X0,X1,Y0,Y1,Z0,Z1"));
  const Outcome field = run_program({"snapshot", directory, "--field", "utilization"});
  CHECK(field.code == 2);
  CHECK(contains(field.err, "the nearest is \"utilisation\""));
  CHECK(run_program({"animate", directory}).code == 0);
  CHECK(read_file(run.file("animation.gif")).starts_with("GIF89a"));
  REQUIRE(run_program({"report", directory}).code == 0);
  const std::string page = read_file(run.file("report.html"));
  CHECK(contains(page, "tension of the membranes"));
  CHECK(contains(page, "data:image/png;base64,"));
}
