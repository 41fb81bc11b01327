// A picture with panels of curves, drawn by gnuplot.
#pragma once

#include <filesystem>
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
  int columns = 1;  ///< panels side by side
};

/// What gnuplot is told; `file` ends in .svg or .png.
std::string gnuplot_script(const Chart& chart, const std::filesystem::path& file);

/// Replaces the file when the picture is complete. Throws RunError if gnuplot is not there or fails, or the disk does
/// not take the picture.
void write_chart(const Chart& chart, const std::filesystem::path& file);

}  // namespace geodrop
