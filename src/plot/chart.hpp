// A picture with panels of curves, drawn by gnuplot.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace geodrop {

enum class SeriesStyle { line, dashed, points, marked_line };

/// Points in the order in which they are joined; a point that is not finite interrupts the line.
struct ChartSeries {
  std::string label;  ///< empty: not in the legend
  std::vector<double> x, y;
  SeriesStyle style = SeriesStyle::line;
};

enum class Aspect { free, equal };
enum class Axes { linear, logarithmic };

struct ChartPanel {
  std::string title, x_label, y_label;  ///< labels with their unit, "time [s]"
  std::vector<ChartSeries> series;
  Aspect aspect = Aspect::free;  ///< equal: a metre is as long in x as in y
  Axes axes = Axes::linear;      ///< logarithmic: both; points that are not > 0 are left out
};

struct Chart {
  std::string title;
  std::vector<ChartPanel> panels;
  int columns = 1;                   ///< panels side by side
  std::vector<std::string> notes{};  ///< lines below the title
};

/// What gnuplot is told; `file` ends in .svg or .png.
std::string gnuplot_script(const Chart& chart, const std::filesystem::path& file);

/// Calls `script` with the name of a file that gnuplot is to draw, runs it, and replaces `picture` when that is
/// complete. Throws RunError if gnuplot is not there, fails, or takes longer than `patience`, or the disk does not take
/// the picture.
void draw_by_gnuplot(const std::filesystem::path& picture,
                     const std::function<std::string(const std::filesystem::path&)>& script,
                     std::chrono::seconds patience = std::chrono::seconds(30));

/// Any text in the quotes of gnuplot.
std::string gnuplot_text(const std::string& text);

/// Replaces the file when the picture is complete. Throws RunError if gnuplot is not there or fails, or the disk does
/// not take the picture.
void write_chart(const Chart& chart, const std::filesystem::path& file);

}  // namespace geodrop
