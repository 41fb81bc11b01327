// Pictures: what stands in them, and that it follows the data.
#include "plot/chart.hpp"

#include "plot/csv_table.hpp"
#include "support/scene_files.hpp"
#include "support/text.hpp"

#include <geodrop/base/error.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

using namespace geodrop;
using geodrop::test::contains;

namespace {

Chart parabola(double end_value = 4) {
  return {"curves", {{"one", "x [m]", "y [m]", {{"measured", {0, 1, 2}, {0, 1, end_value}, SeriesStyle::line}}}}, 1};
}

std::string draw(const Chart& chart) {
  const TemporaryDirectory directory;
  write_chart(chart, directory / "picture.svg");
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(directory / "")) ++files;
  CHECK(files == 1);  // nothing is left but the picture
  return read_file(directory / "picture.svg");
}

/// The path of the first curve, behind that of its sample in the legend.
std::string path_text(const std::string& svg) {
  std::size_t at = svg.find("rgb(  0, 114, 178)");
  REQUIRE(at != std::string::npos);
  at = svg.find("d='", at);
  return svg.substr(at + 3, svg.find('\'', at + 3) - at - 3);
}

/// Its points in pixels, y downwards.
std::vector<std::pair<double, double>> curve(const std::string& svg) {
  std::istringstream path(path_text(svg));
  std::vector<std::pair<double, double>> points;
  for (std::string word; path >> word;) {
    const std::size_t comma = word.find(',');
    points.emplace_back(std::stod(word.substr(1, comma - 1)), std::stod(word.substr(comma + 1)));
  }
  return points;
}

}  // namespace

TEST_CASE("A picture shows every panel, label and point, and moves with a value") {
  Chart chart = parabola();
  chart.panels.push_back({"two", "time [s]", "p_top [Pa]", {{"it's _2", {0, 1}, {5, 5}, SeriesStyle::dashed}}});
  const std::string svg = draw(chart);
  for (const char* text : {"curves", "one", "x [m]", "measured", "two", "time [s]", "p_top [Pa]", "_2"})
    CHECK(contains(svg, text));
  CHECK(contains(svg, "s _2"));

  constexpr std::size_t sample = 2;  // the two ends of the line in the legend, which gnuplot draws first
  const auto points = curve(draw(parabola())), moved = curve(draw(parabola(2)));
  REQUIRE(points.size() == sample + 3);
  const auto height = [&](const auto& of, std::size_t i) { return of[sample].second - of[sample + i].second; };
  CHECK(std::abs(height(points, 1) / height(points, 2) - 0.25) < 0.002);  // pixels have two decimals
  CHECK(std::abs(height(moved, 1) / height(moved, 2) - 0.5) < 0.002);
  CHECK(std::abs((points[sample + 2].first - points[sample].first) / (points[sample + 1].first - points[sample].first) -
                 2) < 0.002);
}

TEST_CASE("Notes stand below the title, in as many lines as they need") {
  Chart chart = parabola();
  const std::string first(60, 'a'), second(60, 'b');
  chart.notes = {"short", first + ' ' + second};
  const std::string script = gnuplot_script(chart, "picture.svg");
  CHECK(contains(script, "title 'curves'.\"\\n\".'short'.\"\\n\".'" + std::string(60, 'a') + "'.\"\\n\".'" +
                             std::string(60, 'b') + "'"));
  CHECK(contains(draw(chart), "short"));
}

TEST_CASE("Equal aspect: a metre is as long in x as in y") {
  Chart chart = parabola();
  chart.panels[0].aspect = Aspect::equal;
  const auto points = curve(draw(chart));
  const double x = points[4].first - points[2].first, y = points[2].second - points[4].second;
  CHECK(std::abs(y / x - 2) < 0.02);
  const auto stretched = curve(draw(parabola()));
  CHECK(std::abs((stretched[2].second - stretched[4].second) / (stretched[4].first - stretched[2].first) - 2) > 0.2);
}

TEST_CASE("Logarithmic axes: a power law is straight, what is not > 0 is left out, the next panel is linear again") {
  Chart chart = parabola();
  chart.panels[0].axes = Axes::logarithmic;
  chart.panels[0].series[0] = {"power", {1, 10, 100, 1000}, {1, 100, 1e4, 0}};
  chart.panels.push_back(parabola().panels[0]);
  chart.panels[1].series[0] = {"line", {-1, 0, 1}, {-1, 0, 1}};
  const auto points = curve(draw(chart));
  REQUIRE(points.size() == 2 + 3);
  CHECK(std::abs((points[4].second - points[2].second) / (points[3].second - points[2].second) - 2) < 0.002);
  CHECK(std::abs((points[4].first - points[2].first) / (points[3].first - points[2].first) - 2) < 0.002);
}

TEST_CASE("A point that is not finite interrupts the line; no series and one value still draw") {
  Chart chart = parabola();
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  chart.panels[0].series[0] = {"gap", {0, 1, 2, 3, 4, 5, 6, 7}, {0, 1, nan, 1, 2, infinity, 0, 1}};
  const std::string path = path_text(draw(chart));
  CHECK(std::count(path.begin(), path.end(), 'M') == 1 + 3);  // the sample, and three pieces that nothing joins
  chart.panels[0].series[0] = {"one", {1, 2}, {3, 3}};
  CHECK(curve(draw(chart)).size() == 2 + 2);
  chart.panels[0].series.clear();
  CHECK(contains(draw(chart), "x [m]"));
}

TEST_CASE("Names cannot end the string that gnuplot reads") {
  Chart chart = parabola();
  chart.panels[0].series[0].label = "a' \n\" ; set output 'elsewhere";
  const std::string script = gnuplot_script(chart, "picture.svg");
  CHECK(contains(script, "title 'a''  \" ; set output ''elsewhere'"));
  CHECK(contains(draw(chart), "set output"));
}

TEST_CASE("PNG by the name of the file") {
  const TemporaryDirectory directory;
  write_chart(parabola(), directory / "picture.png");
  CHECK(read_file(directory / "picture.png").starts_with("\x89PNG"));
}

TEST_CASE("Without gnuplot, or where nothing can be written, there is a message") {
  const TemporaryDirectory directory;
  CHECK_THROWS_AS(write_chart(parabola(), directory / "no_such" / "picture.svg"), RunError);
  const std::string path = std::getenv("PATH");
  setenv("PATH", (directory / "").c_str(), 1);
  std::string said;
  try {
    write_chart(parabola(), directory / "picture.svg");
  } catch (const RunError& error) {
    said = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  CHECK(contains(said, "gnuplot is not installed (Debian: gnuplot-nox)"));
  CHECK_FALSE(std::filesystem::exists(directory / "picture.svg"));
}

TEST_CASE("A table of numbers is read as it was written; what is wrong in it is named by its place") {
  const TemporaryDirectory directory;
  const auto read = [&](const std::string& text) {
    std::ofstream(directory / "table.csv") << text;
    return read_csv(directory / "table.csv");
  };
  const auto said = [&](const std::string& text) {
    try {
      read(text).column("b");
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const CsvTable table = read("a,b\n1,2.5\r\n3,nan\n");
  CHECK(table.rows() == 2);
  CHECK(table.column("b")[0] == 2.5);
  CHECK(std::isnan(table.column("b")[1]));
  CHECK(contains(said("a,b\n1,two\n"), "table.csv:2:3: found \"two\"; allowed: a number"));
  CHECK(contains(said("a,b\n1,2\n3\n"), "table.csv:3:1: found 1 cells; allowed: 2, as the header has"));
  CHECK(contains(said("a,c\n1,2\n"), "found no column b"));
}
