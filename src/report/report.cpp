#include "report.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/reader/scene_reader.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/figures.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "design_check.hpp"
#include "files/read_frames.hpp"
#include "files/run_record.hpp"
#include "html.hpp"
#include "plot/ask_program.hpp"
#include "plot/run_charts.hpp"
#include "scene_values.hpp"
#include "snapshot_picture.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::vector<std::string>>;
using html::table;
using html::text;

/// All that the sections are written from.
struct Source {
  const ReportOptions& options;
  RunRecord record;
  Scene scene;
  CsvTable history;
};

std::string section(const std::string& heading, const std::string& content) {
  return content.empty() ? "" : "<h2>" + heading + "</h2>\n" + content;
}

std::string yes_or_no(bool yes) { return yes ? "<span class=\"yes\">yes</span>" : "<span class=\"no\">no</span>"; }

/// The comment that a scene begins with, without its marks.
std::string leading_comment(const std::string& toml) {
  std::string comment;
  for (std::size_t at = 0; at < toml.size() && toml[at] == '#';) {
    const std::size_t end = std::min(toml.find('\n', at), toml.size());
    std::string line = toml.substr(at + 1, end - at - 1);
    if (line.starts_with(' ')) line.erase(0, 1);
    comment += line + "\n";
    at = end + 1;
  }
  return comment;
}

std::string head(const Source& source) {
  const RunRecord& record = source.record;
  const double t = record.is_running() ? source.history.column("time_s").back() : record.run.t;
  std::string page = "<h1>" + text(record.title) + "</h1>\n";
  if (!source.scene.question.empty()) page += "<p class=\"question\">" + text(source.scene.question) + "</p>\n";
  page += "<p>Run of " + text(record.scene) + " by geodrop " + text(record.version) + ", " +
          text(record.run.ended.empty() ? record.run.started : record.run.ended) + ": <b>" + text(record.status) +
          "</b> at t = " + figure(t, "s") + ".</p>\n";
  if (!record.message.empty()) page += "<p class=\"warning\">" + text(record.message) + "</p>\n";
  return page;
}

std::string warnings(const Source& source) {
  std::string page;
  for (const std::string& warning : source.record.warnings) page += "<p class=\"warning\">" + text(warning) + "</p>\n";
  return page;
}

std::string key_figures(const Source& source) {
  Lines lines{{"result", "value"}};
  for (const Result& result : source.record.results)
    lines.push_back({text(in_words(result.name)), figure(result.value, result.unit)});
  return lines.size() > 1 ? table(lines, {1}) : "";
}

std::string expectations(const Source& source) {
  Lines lines{{"result", "value", "expected", "tolerance", "met", "source"}};
  for (const Expectation& each : source.record.expectations) {
    const std::string& unit = each.result.unit;
    lines.push_back({text(in_words(each.result.name)), figure(each.result.value, unit), figure(each.expected, unit),
                     "&plusmn; " + figure(each.tolerance, unit), yes_or_no(each.met), text(each.source)});
  }
  return lines.size() > 1 ? table(lines, {1, 2, 3}) : "";
}

/// "seam efficiency 0.7, installation 1.3"; empty if nothing reduces.
std::string factors_in_words(const TensionStrength& factors) {
  std::string words;
  const auto add = [&](const char* name, const std::optional<double>& value) {
    if (value) words += (words.empty() ? "" : ", ") + std::string(name) + " " + format_number(*value, 3);
  };
  add("seam efficiency", factors.seam_efficiency);
  add("installation", factors.installation);
  add("creep", factors.creep);
  add("durability", factors.durability);
  add("seams", factors.seam);
  return words;
}

/// A coordinate; what is round-off beside the width of the domain is 0.
std::string place_text(const Source& source, double coordinate) {
  return figure(coordinate, "m", source.scene.grid.upper[0] - source.scene.grid.lower[0]);
}

/// Where bodies in membranes are at the end; empty if there are none.
std::string resting_table(const Source& source) {
  const std::vector<RestingPlace> places = resting_places(source.scene, source.history);
  if (places.empty()) return "";
  const bool plane = source.scene.dimension == 2;
  Lines lines{plane ? std::vector<std::string>{"body", "centre x", "centre y", "lowest point y", "burial", "height",
                                               "width", "tilt", "speed"}
                    : std::vector<std::string>{"body", "centre x", "centre y", "centre z", "lowest point z", "height",
                                               "width along x", "width along y", "turned by", "speed"}};
  for (const RestingPlace& place : places) {
    std::vector<std::string> cells{text(place.body)};
    for (const double coordinate : place.centre) cells.push_back(place_text(source, coordinate));
    cells.push_back(place_text(source, place.lowest));
    if (plane) cells.push_back(place.burial ? place_text(source, *place.burial) : "-");
    cells.insert(cells.end(), {figure(place.height, "m"), figure(place.width, "m")});
    if (place.depth) cells.push_back(figure(*place.depth, "m"));
    cells.insert(cells.end(), {figure(place.turn_deg, "degree"), figure(place.speed, "m/s")});
    lines.push_back(cells);
  }
  std::vector<std::size_t> numbers(lines.front().size() - 1);
  std::iota(numbers.begin(), numbers.end(), 1);
  std::string page = "<p>Place and shape at t = " + figure(places.back().time, "s") + ":</p>\n" + table(lines, numbers);
  if (std::ranges::any_of(places, [](const RestingPlace& place) { return place.burial.has_value(); }))
    page +=
        "<p>Burial: depth of the lowest point below the surface that the bed had there at the start; negative: "
        "above it.</p>\n";
  for (const RestingPlace& place : places)
    if (place.is_moving())
      page += "<p class=\"warning\">" + text(place.body) + " still moves at " + figure(place.speed, "m/s") +
              ": not a resting shape.</p>\n";
  return page;
}

std::string design_check(const Source& source) {
  std::string page;
  Lines lines{{"membrane", "largest tension", "at", "place", "strength", "allowable", "safety"}};
  for (const PeakTension& peak : peak_tensions(source.scene, source.history)) {
    TensionStrength factors = source.options.factors;
    factors.strength = peak.strength;
    const std::optional<double> factor = safety(peak, factors);
    std::string place;
    for (std::size_t axis = 0; axis < peak.place.size(); ++axis)
      place += std::string(axis == 0 ? "" : ", ") + "xyz"[axis] + " = " + place_text(source, peak.place[axis]);
    lines.push_back(
        {text(peak.membrane), figure(peak.tension, "N/m"), figure(peak.time, "s"), place,
         factor ? figure(peak.strength, "N/m") : "not given", factor ? figure(allowable_tension(factors), "N/m") : "-",
         factor ? "<span class=\"" + std::string(*factor >= 1 ? "yes" : "no") + "\">" + figure(*factor, "1") + "</span>"
                : "-"});
  }
  if (lines.size() > 1) {
    const std::string words = factors_in_words(source.options.factors);
    page += table(lines, {1, 2, 4, 5, 6}) +
            "<p>Largest tension: mean over the gauge length and 10 ms, in the whole run. Allowable: strength of the "
            "geotextile" +
            (words.empty() ? ", not reduced (seams, installation, creep, durability: options of <code>geodrop "
                             "report</code>)"
                           : " reduced by " + text(words)) +
            ". Safety: allowable over largest.</p>\n";
  }
  return page + resting_table(source);
}

/// Pictures are drawn beside the report and go into it.
template <class Draw>
std::string embed(const Source& source, const std::string& ending, const Draw& draw,
                  const std::function<std::string(const fs::path&)>& place) {
  const fs::path file = source.options.output.string() + ending;
  draw(file);
  std::string html = place(file);
  fs::remove(file);
  return html;
}

/// Two panels on a page, so that their words can be read in print.
std::vector<Chart> pages_of(const Chart& chart) {
  std::vector<Chart> pages;
  for (std::size_t p = 0; p < chart.panels.size(); p += 2) {
    const auto first = chart.panels.begin() + static_cast<std::ptrdiff_t>(p);
    const std::ptrdiff_t count = std::min<std::ptrdiff_t>(2, chart.panels.end() - first);
    pages.push_back({chart.title, {first, first + count}, 1, p == 0 ? chart.notes : std::vector<std::string>{}});
  }
  return pages;
}

std::string histories(const Source& source) {
  std::string page;
  for (const NamedChart& chart : run_charts(source.options.directory, source.options.factors))
    for (const Chart& part : pages_of(chart.chart))
      page += embed(
          source, ".svg", [&](const fs::path& file) { write_chart(part, file); },
          [&](const fs::path& file) { return html::drawing(file, chart.stem); });
  return page;
}

/// A frame to be drawn, and why.
struct Instant {
  double time = 0;
  std::string why;
  bool is_end = false;
};

/// Start, times that results tell, largest tensions, end.
std::vector<Instant> key_instants(const Source& source) {
  constexpr std::size_t most = 6;
  std::vector<Instant> instants{{0, "start"}};
  const double end = source.record.run.t;
  for (const Result& result : source.record.results)
    if (result.unit == "s" && result.value > 0 && result.value < end)
      instants.push_back({result.value, in_words(result.name)});
  for (const PeakTension& peak : peak_tensions(source.scene, source.history))
    instants.push_back({peak.time, "largest tension in " + peak.membrane});
  if (instants.size() >= most) instants.resize(most - 1);
  instants.push_back({end, "end", true});
  std::ranges::stable_sort(instants, {}, &Instant::time);
  return instants;
}

/// Around the membranes of a frame, if they are small in the whole picture.
std::optional<Extent> membrane_window(const Snapshot& snapshot, const Scene& scene) {
  if (snapshot.membranes.points.empty()) return std::nullopt;
  Extent window = extent_of(snapshot.membranes.points);
  constexpr double around = 0.35, small = 0.4;
  window.widen(around * std::max({window.size(0), window.size(1), window.size(2)}));
  const bool is_small = window.size(0) < small * (scene.grid.upper[0] - scene.grid.lower[0]);
  return is_small ? std::optional(window) : std::nullopt;
}

/// A picture of a frame and what it shows.
struct CaptionedPicture {
  PictureOptions options;
  std::string caption;
};

/// Of the tension of membranes, the same in all pictures so that they can be compared: to the largest of the run.
/// Nothing if there is none.
std::optional<ValueRange> tensions_of_run(const Source& source) {
  double largest = 0;
  for (const MembraneSpec& membrane : source.scene.membranes) {
    const std::string column = membrane.name + ".tension_max_N_m";
    if (!source.history.has(column)) continue;
    for (const double tension : source.history.column(column))
      if (std::isfinite(tension)) largest = std::max(largest, tension);
  }
  return largest > 0 ? std::optional(ValueRange{0, largest}) : std::nullopt;
}

/// Of what the stress of particles is, beside its sign.
std::string stress_caption(const Scene& scene) {
  const bool has_coupled =
      std::ranges::any_of(scene.bodies, [](const BodySpec& body) { return !body.saturated_by.empty(); });
  return std::string("vertical stress, tension positive") + (has_coupled ? ", of coupled soil the effective one" : "");
}

/// Bodies and layers, in space membranes from outside; velocities near a small membrane; pressures and stresses at the
/// end.
std::vector<CaptionedPicture> pictures_of(const Snapshot& snapshot, const Scene& scene, const Instant& instant,
                                          const std::optional<ValueRange>& tensions) {
  const std::optional<Extent> close = membrane_window(snapshot, scene);
  const std::vector<std::string> fields = picture_fields(snapshot);  // output.fields may leave some out
  const auto written = [&](const char* name) { return std::ranges::find(fields, name) != fields.end(); };
  std::vector<CaptionedPicture> pictures;
  const auto add = [&](const char* field, const std::optional<Extent>& window, const std::string& caption) {
    CaptionedPicture& picture = pictures.emplace_back();
    picture.options.field = field;
    picture.options.window = window;
    picture.options.tensions = tensions;
    picture.caption = caption;
  };
  const bool has_particles = !snapshot.particles.points.empty();
  if (has_particles) add("layers", {}, "bodies and layers");
  if (scene.dimension == 3 && written("tension")) add("tension", close, "tension of the membranes");
  if (has_particles && close && instant.time > 0 && written("velocity")) add("velocity", close, "velocity");
  if (has_particles && instant.is_end && written("mean_pressure"))
    add("mean_pressure", close, "mean pressure, compression positive");
  const char* const vertical = scene.dimension == 3 ? "stress_zz" : "stress_yy";
  if (has_particles && instant.is_end && written(vertical)) add(vertical, close, stress_caption(scene));
  return pictures;
}

std::string pictures(const Source& source) {
  if (!fs::exists(source.options.directory / "particles.pvd")) return "";
  const std::vector<double> times = frame_times(source.options.directory);
  std::map<std::size_t, Instant> frames;
  for (const Instant& instant : key_instants(source)) {
    const auto [at, is_first] = frames.try_emplace(frame_near(times, instant.time), instant);
    if (is_first) continue;
    at->second.why += ", " + instant.why;
    at->second.is_end |= instant.is_end;
  }
  const std::optional<ValueRange> tensions = tensions_of_run(source);
  std::string page;
  for (const auto& [index, instant] : frames) {
    const Snapshot snapshot = read_frame(source.options.directory, index);
    const std::string time = "t = " + figure(snapshot.t, "s") + ", " + instant.why;
    for (const CaptionedPicture& picture : pictures_of(snapshot, source.scene, instant, tensions))
      page += embed(
          source, ".png", [&](const fs::path& file) { draw_snapshot(source.scene, snapshot, picture.options, file); },
          [&](const fs::path& file) { return html::picture(file, time + ": " + picture.caption); });
  }
  return page;
}

std::string balances(const Source& source) {
  Lines lines{{"", "start", "end", "change", "least", "most"}};
  for (const std::string& column : source.history.names) {
    if (!column.starts_with("energy.") && !column.starts_with("total.")) continue;
    const std::vector<double>& values = source.history.column(column);
    const auto [least, most] = std::ranges::minmax(values);
    const Scaled unit = scaled_unit(unit_of_name(column), std::max(std::abs(least), std::abs(most)));
    const auto cell = [&](double value) { return figure(value, unit); };
    lines.push_back({text(in_words(column.substr(column.find('.') + 1)) + " [" + unit.unit + "]"), cell(values.front()),
                     cell(values.back()), cell(values.back() - values.front()), cell(least), cell(most)});
  }
  if (lines.size() == 1) return "";
  return table(lines, {1, 2, 3, 4, 5}) +
         (source.scene.dimension == 2 ? "<p>Per metre of depth. Dissipated: friction, plastic flow, viscosity and "
                                        "what the scheme damps.</p>\n"
                                      : "");
}

std::string timing(const Source& source) {
  constexpr std::size_t most = 8;
  const RunRecord& record = source.record;
  std::vector<StageTime> stages = record.stages;
  std::ranges::sort(stages, std::greater<>(), &StageTime::seconds);
  double sum = 0;
  for (const StageTime& stage : stages) sum += stage.seconds;
  stages.resize(std::min(stages.size(), most));
  Lines lines{{"part of the step", "wall time [s]", "share"}};
  for (const StageTime& stage : stages)
    lines.push_back(
        {text(stage.name), figure(stage.seconds, Scaled{}), figure(100 * stage.seconds / sum, Scaled{}) + " %"});
  return "<p>" + std::to_string(record.run.steps) + " steps of " + std::to_string(record.run.particles) +
         " particles in " + format_duration(record.wall_seconds) + " on " + std::to_string(record.run.threads) +
         " thread(s) of " + text(record.run.host) + ".</p>\n" + (stages.empty() ? "" : table(lines, {1, 2}));
}

std::string origin(const Source& source) {
  return "<p>Command: <code>" + text(source.record.run.command) + "</code><br>State at the end: <code>" +
         text(source.record.state_hash) + "</code> (docs/reproducibility.md)</p>\n";
}

std::string remarks(const fs::path& scene) {
  const std::string comment = leading_comment(text_of_file(scene));
  return comment.empty() ? "" : "<pre class=\"comment\">" + text(comment) + "</pre>\n";
}

}  // namespace

void write_report(const ReportOptions& options) {
  const fs::path scene = options.directory / "scene.toml";
  const Source source{options, read_run_record(options.directory), read_scene(scene), read_history(options.directory)};
  const std::string body = head(source) + warnings(source) + section("Key figures", key_figures(source)) +
                           section("Beside what was expected", expectations(source)) +
                           section("Design check", design_check(source)) + section("Histories", histories(source)) +
                           section("Pictures", pictures(source)) + section("Scene", scene_values_html(scene)) +
                           section("Remarks of the scene", remarks(scene)) +
                           section("Balance of mass and energy", balances(source)) + section("Time", timing(source)) +
                           section("Origin", origin(source));
  write_file_atomically(options.output, html::page(source.record.title, body));
}

void print_pdf(const fs::path& page, const fs::path& pdf) {
  constexpr std::chrono::seconds patience{120};
  const std::string from = fs::absolute(page).string(), to = fs::absolute(pdf).string();
  std::vector<std::vector<std::string>> programs;
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    programs.push_back({name, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer",
                        "--print-to-pdf=" + to, "file://" + from});
  programs.push_back({"weasyprint", from, to});
  for (const auto& words : programs) {
    const Answer answer = ask_program(words, patience);
    if (answer.code == exit_not_found) continue;
    if (answer.timed_out || answer.code != 0 || !fs::exists(pdf))
      throw RunError(words.front() + " could not print " + to + ": " + answer.said);
    return;
  }
  throw RunError(
      "no program here prints PDF: install chromium or weasyprint (Debian packages of these names), or print " + from +
      " from a browser");
}

}  // namespace geodrop
