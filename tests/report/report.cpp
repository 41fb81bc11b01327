// The report of a run, the design check behind it, and runs side by side.
#include "plot/csv_table.hpp"
#include "report/design_check.hpp"
#include "report/html.hpp"
#include "report/scene_values.hpp"
#include "support/near.hpp"
#include "support/program.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>

using namespace geodrop;
using namespace geodrop::test;

namespace {

Scene scene_with_bag(double strength) {
  Scene scene;
  MembraneSpec membrane;
  membrane.name = "cloth";
  membrane.body = "bag";
  membrane.axial_stiffness = 1e6;
  membrane.strength = strength;
  scene.membranes.push_back(membrane);
  return scene;
}

const CsvTable history{{"time_s", "cloth.tension_gauge_N_m", "cloth.tension_gauge_time_s", "cloth.tension_gauge_x_m",
                        "cloth.tension_gauge_y_m", "bag.position_x_m", "bag.position_y_m", "bag.velocity_x_m_s",
                        "bag.velocity_y_m_s", "bag.rotation_deg", "bag.height_m", "bag.width_m", "bag.lowest_m"},
                       {{0, 1, 2},
                        {0, 30e3, 20e3},
                        {0, 0.95, 1.7},
                        {0, 0.5, 2},
                        {9, 4, 1},
                        {0, 1, 2},
                        {9, 5, 0.5},
                        {0, 0, 3},
                        {0, -4, 4},
                        {5, 30, 89},
                        {6, 6, 1},
                        {1, 2, 5},
                        {7, 3, -0.2}}};

}  // namespace

TEST_CASE("Design check: the largest tension with its own time and place, against what reduction leaves") {
  const auto peaks = peak_tensions(scene_with_bag(120e3), history);
  REQUIRE(peaks.size() == 1);
  CHECK(peaks[0].tension == 30e3);
  CHECK(peaks[0].time == 0.95);
  CHECK(peaks[0].place == std::vector{0.5, 4.0});
  CHECK(safety(peaks[0], {}).value() == near(4, 1e-12));
  // 120 kN/m * 0.7 / (1.3 * 1.5) = 43.08 kN/m.
  TensionStrength factors{};
  factors.seam_efficiency = 0.7;
  factors.installation = 1.3;
  factors.creep = 1.5;
  CHECK(safety(peaks[0], factors).value() == near(43.0769e3 / 30e3, 1e-5));
  CHECK_FALSE(safety(peak_tensions(scene_with_bag(0), history)[0], factors).has_value());
}

TEST_CASE("A body in a closed membrane rests where its last row says") {
  const auto places = resting_places(scene_with_bag(0), history);
  REQUIRE(places.size() == 1);
  CHECK(places[0].centre == std::vector{2.0, 0.5});
  CHECK(places[0].turn_deg == 89);
  CHECK(places[0].speed == near(5, 1e-12));
  CHECK(places[0].lowest == -0.2);
  CHECK(places[0].is_moving());
  RestingPlace quivers = places[0];
  quivers.speed = 0.05;
  CHECK_FALSE(quivers.is_moving());
}

TEST_CASE("In space a body in a membrane has three coordinates, two widths, and the angle about its own axis") {
  Scene scene = scene_with_bag(0);
  scene.dimension = 3;
  scene.membranes[0].body = "";
  BodySpec fill;
  fill.name = "bag";
  fill.shape = InsideShape{"cloth"};
  scene.bodies = {fill};
  const CsvTable last_row{
      {"time_s",
       "bag.position_x_m",
       "bag.position_y_m",
       "bag.position_z_m",
       "bag.velocity_x_m_s",
       "bag.velocity_y_m_s",
       "bag.velocity_z_m_s",
       "bag.rotation_x_deg",
       "bag.rotation_y_deg",
       "bag.rotation_z_deg",
       "bag.height_m",
       "bag.width_m",
       "bag.lowest_m",
       "bag.frontmost_m",
       "bag.backmost_m",
       "cloth.tension_gauge_N_m",
       "cloth.tension_gauge_time_s",
       "cloth.tension_gauge_x_m",
       "cloth.tension_gauge_y_m",
       "cloth.tension_gauge_z_m"},
      {{5}, {1}, {2}, {3}, {1}, {2}, {2}, {30}, {0}, {40}, {0.5}, {4}, {2.75}, {1.5}, {3.5}, {9}, {4}, {7}, {8}, {6}}};
  const auto places = resting_places(scene, last_row);
  REQUIRE(places.size() == 1);
  CHECK(places[0].centre == std::vector{1.0, 2.0, 3.0});
  CHECK(places[0].speed == near(3, 1e-12));
  CHECK(places[0].turn_deg == near(50, 1e-12));
  CHECK(places[0].width == 4);
  CHECK(places[0].depth.value() == near(2, 1e-12));
  CHECK(places[0].lowest == 2.75);
  CHECK_FALSE(places[0].burial.has_value());
  CHECK(peak_tensions(scene, last_row).at(0).place == std::vector{7.0, 8.0, 6.0});
}

TEST_CASE("Burial is counted from the surface of the bed at the start, below a trench, of soil in no membrane") {
  const auto body = [](const char* name, const char* material, const Shape& shape) {
    BodySpec spec;
    spec.name = name;
    spec.material = material;
    spec.shape = shape;
    return spec;
  };
  Scene scene = scene_with_bag(0);
  scene.materials = {{"water", NewtonianSpec{}, {}}, {"sand", MohrCoulombSpec{}, {}}};
  CHECK_FALSE(bed_surface(scene, "", 2).has_value());
  scene.bodies = {body("water", "water", BoxShape{{-9, 0}, {9, 13}}), body("bag", "sand", BoxShape{{1, 5}, {3, 6}}),
                  body("bed", "sand", BoxShape{{-9, -4}, {9, 0.5}}),
                  body("trench", "water", BoxShape{{4, -1}, {6, 2}})};
  scene.bodies[2].minus = {"trench"};
  CHECK(bed_surface(scene, "", 2).value() == 0.5);
  CHECK(bed_surface(scene, "", 5).value() == -1);
  CHECK(bed_surface(scene, "trench", 5).value() == 2);
  CHECK_FALSE(bed_surface(scene, "", 20).has_value());
  CHECK(resting_places(scene, history).at(0).burial.value() == near(0.7, 1e-12));  // its lowest point is at -0.2
}

TEST_CASE("Base64 of RFC 4648, and text that HTML would take for its own") {
  CHECK(html::base64("") == "");
  CHECK(html::base64("f") == "Zg==");
  CHECK(html::base64("fo") == "Zm8=");
  CHECK(html::base64("foobar") == "Zm9vYmFy");
  CHECK(html::base64("\xff\xfe\xfd") == "//79");
  CHECK(html::text("a < b & \"c\"") == "a &lt; b &amp; &quot;c&quot;");
}

TEST_CASE(
    "Values of a scene: lists without blanks, no unit behind an empty one; shortest numbers, texts without quotes") {
  const TemporaryDirectory directory;
  const std::string scene = directory / "scene.toml";
  std::ofstream(scene) << "gravity = [0.1, -9.81]\n[grid]\nlower = [-3.0, -1.0]\n"
                          "[[membranes]]\nname = \"cloth\"\nbody = \"bag\"\npoints = []\n";
  const std::string html = scene_values_html(scene);
  CHECK(contains(html, ">[-3, -1] m<"));
  CHECK(contains(html, ">[]<"));
  using Entry = std::pair<std::string, std::string>;
  CHECK(flat_scene(scene) == std::vector<Entry>{{"gravity", "[0.1, -9.81]"},
                                                {"grid.lower", "[-3, -1]"},
                                                {"membranes.cloth.body", "bag"},
                                                {"membranes.cloth.name", "cloth"},
                                                {"membranes.cloth.points", "[]"}});
}

TEST_CASE("report writes one page with all in it; compare tells what differs") {
  const SceneRun run("cases/dump_kekerdom_mixture.toml", {"grid.spacing=0.5", "time.end=0.2"});
  REQUIRE(run.outcome().code == 0);
  const std::string directory = run.file("").string();
  const Outcome report = run_program({"report", directory, "--seam-efficiency", "0.5"});
  CAPTURE(report.err);
  REQUIRE(report.code == 0);
  const std::string page = read_file(run.file("report.html"));
  for (const char* part : {"<h1>", "Key figures", "Beside what was expected", "Design check", "seam efficiency 0.5",
                           "Histories", "Pictures", "data:image/png;base64,", "data:image/svg+xml;base64,",
                           "material water", "1000 kg/m3", "Balance of mass and energy", "geodrop run",
                           "Remarks of the scene", "burial", "end: vertical stress, tension positive",
                           "the surface that the bed had", ">[-16, -2] m<", "container still moves at "})
    CHECK_MESSAGE(contains(page, part), part);
  CHECK_FALSE(contains(page, "src=\"http"));
  std::size_t drawings = 0;
  for (std::size_t at = page.find("svg+xml"); at != std::string::npos; at = page.find("svg+xml", at + 1)) ++drawings;
  CHECK(drawings == 2);  // of two panels each
  // A key that several laws have is told with the meaning that it has in its own.
  const auto times = [&](const std::string& words) {
    std::size_t count = 0;
    for (std::size_t at = page.find(words); at != std::string::npos; at = page.find(words, at + 1)) ++count;
    return count;
  };
  CHECK(times("of a fluid: at zero pressure") == 1);
  // Nothing is left but the page.
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    CHECK_FALSE(entry.path().filename().string().starts_with("report.html."));
  CHECK(contains(read_file(run.file("scene.toml")), "# "));

  const SceneRun other("cases/dump_kekerdom_mixture.toml", {"grid.spacing=0.5", "time.end=0.1"});
  const Outcome compared = run_program({"compare", directory, other.file("").string()});
  CHECK(compared.code == 0);
  CHECK(contains(compared.out, "time.end  "));
  CHECK(contains(compared.out, "  0.2  "));  // not 0.20000000000000001
  CHECK_FALSE(contains(compared.out, "grid.spacing"));
  CHECK(contains(compared.out, "of the first"));
  CHECK(run_program({"compare", directory, "/nowhere"}).code == 2);
  CHECK(run_program({"report", "/nowhere"}).code == 2);
}

TEST_CASE("report --pdf without a program that prints names what to install") {
  const SceneRun run("cases/gravity_column.toml", {"time.end=0.05"});
  REQUIRE(run.outcome().code == 0);
  const std::string page = run.file("report.html").string();
  const std::string search = std::getenv("PATH");
  const TemporaryDirectory only_gnuplot;
  for (const char* folder : {"/usr/bin", "/bin", "/usr/local/bin"})
    if (std::filesystem::exists(std::string(folder) + "/gnuplot")) {
      std::filesystem::create_symlink(std::string(folder) + "/gnuplot", only_gnuplot / "gnuplot");
      break;
    }
  setenv("PATH", (only_gnuplot / "").c_str(), 1);
  const Outcome outcome = run_program({"report", run.file("").string(), "--pdf"});
  setenv("PATH", search.c_str(), 1);
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.err, "install chromium or weasyprint"));
  CHECK(std::filesystem::exists(page));
}
