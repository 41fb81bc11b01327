// The script for gnuplot: data inline, so that nothing but the picture is left behind.
#include "chart.hpp"

#include "ask_program.hpp"

#include "base/atomic_file.hpp"
#include "base/text.hpp"

#include <geodrop/base/error.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>

namespace geodrop {
namespace {

namespace fs = std::filesystem;

/// Colours that differ in lightness as well, for print and for colour-blind readers (Okabe & Ito).
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(const std::vector<double>& values) {
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  /// A line of one value gets room above and below, where gnuplot would warn.
  std::string range(Axes axes) const {
    constexpr double room = 1.5;  // factor on a logarithmic axis
    if (low > high) return axes == Axes::logarithmic ? "[1:10]" : "[0:1]";
    if (axes == Axes::logarithmic) return "[" + format_number(low / room) + ":" + format_number(high * room) + "]";
    const double margin = high > low ? 0.04 * (high - low) : std::max(std::abs(high), 1.0) * 0.5;
    return "[" + format_number(low - margin) + ":" + format_number(high + margin) + "]";
  }
};

/// Without what a logarithmic axis cannot show.
ChartSeries on_axes(ChartSeries series, Axes axes) {
  const auto hide = [&](double& value) {
    if (axes == Axes::logarithmic && value <= 0) value = std::numeric_limits<double>::quiet_NaN();
  };
  std::for_each(series.x.begin(), series.x.end(), hide);
  std::for_each(series.y.begin(), series.y.end(), hide);
  return series;
}

std::string data_block(const std::string& name, const ChartSeries& series) {
  std::string text = name + " << EOD\n";
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    const bool is_point = std::isfinite(series.x[i]) && std::isfinite(series.y[i]);
    text += is_point ? format_number(series.x[i]) + " " + format_number(series.y[i]) + "\n" : "NaN NaN\n";
  }
  return text + "EOD\n";
}

std::string style_text(SeriesStyle style, std::size_t number) {
  const std::string colour = std::string(" linecolor rgb '") + colours[number % colours.size()] + "'";
  if (style == SeriesStyle::points) return "with points pointtype 6 pointsize 0.4" + colour;
  if (style == SeriesStyle::marked_line) return "with linespoints linewidth 1.6 pointtype 7 pointsize 0.6" + colour;
  return "with lines linewidth 1.6" + colour + (style == SeriesStyle::dashed ? " dashtype 2" : "");
}

std::string panel_text(const ChartPanel& panel, std::size_t number) {
  std::string data, plots;
  Extent x, y;
  for (std::size_t s = 0; s < panel.series.size(); ++s) {
    const ChartSeries series = on_axes(panel.series[s], panel.axes);
    const std::string name = "$panel" + std::to_string(number) + "_" + std::to_string(s);
    data += data_block(name, series);
    x.add(series.x);
    y.add(series.y);
    plots += (s == 0 ? "plot " : ", \\\n     ") + name + " using 1:2 " + style_text(series.style, s) +
             (series.label.empty() ? " notitle" : " title " + gnuplot_text(series.label));
  }
  if (panel.series.empty()) plots = "plot NaN notitle";
  // The line feed keeps the legend off the label.
  return data + "set title " + gnuplot_text(panel.title) + "\nset xlabel " + gnuplot_text(panel.x_label) + ".\"\\n\"" +
         "\nset ylabel " + gnuplot_text(panel.y_label) + "\nset size ratio " +
         (panel.aspect == Aspect::equal ? "-1" : "0") +
         (panel.axes == Axes::logarithmic ? "\nset logscale xy" : "\nunset logscale") + "\nset xrange " +
         x.range(panel.axes) + "\nset yrange " + y.range(panel.axes) + "\n" + plots + "\n";
}

/// Lines of at most so many letters, broken between words.
std::vector<std::string> wrapped(const std::string& text, std::size_t most) {
  std::vector<std::string> lines{""};
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > most) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
}

/// A file that goes away with its owner.
struct PassingFile {
  fs::path path;
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;
  explicit PassingFile(fs::path at) : path(std::move(at)) {}
  ~PassingFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

}  // namespace

/// Names come from scene files, so they may hold anything.
std::string gnuplot_text(const std::string& text) {
  std::string word = "'";
  for (const char letter : text) {
    if (letter == '\'') word += '\'';
    word += static_cast<unsigned char>(letter) < ' ' ? ' ' : letter;
  }
  return word + "'";
}

std::string gnuplot_script(const Chart& chart, const fs::path& file) {
  constexpr int panel_width = 720, panel_height = 480;  // [px]
  constexpr std::size_t letters_per_panel = 95;
  const int panels = static_cast<int>(chart.panels.size()), columns = std::clamp(chart.columns, 1, std::max(panels, 1));
  const int rows = std::max(1, (panels + columns - 1) / columns);
  const std::string size = std::to_string(columns * panel_width) + "," + std::to_string(rows * panel_height);
  const std::string terminal = file.string().ends_with(".png") ? "pngcairo" : "svg";
  std::string title = gnuplot_text(chart.title);
  for (const std::string& note : chart.notes)
    for (const std::string& line : wrapped(note, static_cast<std::size_t>(columns) * letters_per_panel))
      title += ".\"\\n\"." + gnuplot_text(line);
  // Five digits along x, where numbers stand side by side.
  std::string text = "set encoding utf8\nset terminal " + terminal + " noenhanced size " + size +
                     " font 'sans,12' background rgb 'white'\nset output " + gnuplot_text(file.string()) +
                     "\nset grid linetype 1 linewidth 0.5 linecolor rgb '#d0d0d0'\nset key below Left reverse samplen "
                     "2\nset format x '% .5g'\nset multiplot layout " +
                     std::to_string(rows) + "," + std::to_string(columns) + " title " + title + "\n";
  for (std::size_t p = 0; p < chart.panels.size(); ++p) text += panel_text(chart.panels[p], p);
  return text + "unset multiplot\nunset output\n";
}

void draw_by_gnuplot(const fs::path& relative, const std::function<std::string(const fs::path&)>& script_for,
                     std::chrono::seconds patience) {
  const fs::path file = fs::absolute(relative);  // no name that gnuplot could take for an option
  const PassingFile script(file.string() + ".gnuplot"), picture(file.string() + ".part" + file.extension().string());
  write_file_atomically(script.path, script_for(picture.path));
  // -d: not what the user's ~/.gnuplot says.
  const Answer answer = ask_program({"gnuplot", "-d", script.path.string()}, patience);
  if (answer.timed_out)
    throw RunError("gnuplot did not draw " + file.string() + " in " + std::to_string(patience.count()) +
                   " s and was ended");
  if (answer.code == exit_not_found)
    throw RunError("cannot draw " + file.string() + ": gnuplot is not installed (Debian: gnuplot-nox)");
  if (answer.code != 0 || !fs::exists(picture.path))
    throw RunError("gnuplot could not draw " + file.string() + ": " + answer.said);
  fs::rename(picture.path, file);
}

void write_chart(const Chart& chart, const fs::path& file) {
  draw_by_gnuplot(file, [&](const fs::path& picture) { return gnuplot_script(chart, picture); });
}

}  // namespace geodrop
