#include "picture_page.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "plot/chart.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;

// Places in pixels.
constexpr int left = 80, below = 64, above = 44, heading = 26, highest = 760, least = 220;
constexpr int widest = 1040, widest_of_two = 1320;  ///< of all views together
constexpr int beside = 26, bar_width = 22, bar_place = 136, legend_place = 190;

int right_of(const Panel& panel) { return panel.left + panel.pixels.width; }

/// Shares of the picture.
struct Shares {
  const PictureLayout& layout;

  std::string x(double at) const { return format_number(at / layout.width, 6); }
  std::string y(double at) const { return format_number(at / layout.height, 6); }
  /// Margins of a plot as high as the views, from and to these pixels.
  std::string margins(double from, double to) const {
    return "set lmargin at screen " + x(from) + "\nset rmargin at screen " + x(to) + "\nset bmargin at screen " +
           y(below) + "\nset tmargin at screen " + y(below + layout.panels.front().pixels.height) + "\n";
  }
};

std::string point_text(const std::vector<double>& points, std::size_t i) {
  return format_number(points[3 * i]) + " " + format_number(points[3 * i + 1]);
}

std::string range_text(double low, double high) { return "[" + format_number(low) + ":" + format_number(high) + "]"; }

/// Lines of two points each, with their colours.
std::string membrane_data(const MembraneSnapshot& membranes, const std::vector<double>& values, const ColourBar& bar) {
  std::string text = "$membranes << EOD\n";
  for (std::size_t s = 0; s < values.size(); ++s) {
    const std::string colour = " " + std::to_string(rgb(bar.colour(values[s]))) + "\n";
    for (const std::size_t end : {2 * s, 2 * s + 1})
      text += point_text(membranes.points, membranes.connectivity[end]) + colour;
    text += "\n";
  }
  return text + "EOD\n";
}

/// Lines of rigid bodies: outlines, boundaries of half-planes and half-spaces, edges in space.
struct RigidLines {
  std::string closed, open, edges;
};
RigidLines rigid_lines(const Scene& scene, const RigidSnapshot& rigid) {
  RigidLines lines;
  for (const auto& [first, end] : lines_by_body(rigid)) {
    std::string outline, separate;
    for (std::size_t line = first; line < end; ++line) {
      const std::string from = point_text(rigid.points, rigid.connectivity[2 * line]) + "\n";
      outline += from;
      separate += from + point_text(rigid.points, rigid.connectivity[2 * line + 1]) + "\n\n";
    }
    outline += point_text(rigid.points, rigid.connectivity[2 * end - 1]) + "\n\n";
    if (is_plane_without_end(scene, rigid.rigid[first]))
      lines.open += outline;
    else if (scene.dimension == 3)
      lines.edges += separate;
    else
      lines.closed += outline;
  }
  return lines;
}

std::string domain_data(const GridSpec& grid, const Facing& facing) {
  std::string text = "$domain << EOD\n";
  for (const auto& [upper_x, upper_y] :
       {std::pair(false, false), {true, false}, {true, true}, {false, true}, {false, false}})
    text += format_number((upper_x ? grid.upper : grid.lower)[facing.axis[0]]) + " " +
            format_number((upper_y ? grid.upper : grid.lower)[facing.axis[1]]) + "\n";
  return text + "EOD\n";
}

/// The colours of a bar as a picture of its own, numbers on its right.
std::string bar_text(const ColourBar& bar, const PictureLayout& layout, int from, const std::string& name) {
  constexpr int steps = 128;
  const double low = bar.range.first * bar.unit.factor, high = bar.range.second * bar.unit.factor;
  const double step = (high - low) / steps;
  std::string data = name + " << EOD\n";
  for (int i = 0; i < steps; ++i) {
    const Colour colour = colour_at(bar.scale, (i + 0.5) / steps);
    for (const int x : {0, 1})
      data += std::to_string(x) + " " + format_number(low + (i + 0.5) * step) + " " + std::to_string(colour.red) + " " +
              std::to_string(colour.green) + " " + std::to_string(colour.blue) + "\n";
  }
  const std::string unit = bar.unit.unit.empty() ? "-" : bar.unit.unit;
  return data + "EOD\n" + Shares{layout}.margins(from, from + bar_width) +
         "set title ''\nset xlabel ''\nset ylabel ''\nunset xtics\nunset ytics\nset y2tics format '% .4g' out\n"
         "set y2label " +
         gnuplot_text(bar.label + " [" + unit + "]") + " offset character 0,0\nset xrange [-0.5:1.5]\nset y2range " +
         range_text(low, high) + "\nset yrange " + range_text(low, high) + "\nplot " + name +
         " using 1:2:3:4:5 with rgbimage notitle\nunset y2tics\nset y2label ''\nset xtics\nset ytics\n";
}

/// Squares and names on the right of the views, from the top.
std::string legend_text(const std::vector<LegendEntry>& legend, const PictureLayout& layout) {
  constexpr int square = 16, line = 24;
  const Shares at{layout};
  std::string text;
  const double x = right_of(layout.panels.back()) + 20;
  double y = below + layout.panels.front().pixels.height - square;
  for (const LegendEntry& entry : legend) {
    const bool is_second = entry.name.empty();  // colour of the entry before
    if (is_second) y += line;
    const double from = x + (is_second ? square : 0);
    const std::string colour = fmt::format("#{:06x}", static_cast<unsigned>(rgb(entry.colour)));
    text += "set object rectangle from screen " + at.x(from) + "," + at.y(y) + " to screen " + at.x(from + square) +
            "," + at.y(y + square) + " fillcolor rgb '" + colour + "' fillstyle solid noborder\n";
    if (!is_second)
      text += "set label " + gnuplot_text(entry.name) + " at screen " + at.x(x + 2 * square + 8) + "," +
              at.y(y + square / 2.0) + "\n";
    y -= line;
  }
  return text;
}

/// Axes of a view.
std::string axes_text(const PaintedView& painted, const Panel& panel) {
  const auto label = [&](int axis) { return std::string("'") + "xyz"[painted.view.facing.axis[axis]] + " [m]'"; };
  const Window& window = panel.window;
  return "set xlabel " + label(0) + "\nset ylabel " + label(1) + " offset character 1,0" + "\nset xrange " +
         range_text(window.lower[0], window.upper[0]) + "\nset yrange " + range_text(window.lower[1], window.upper[1]) +
         "\nset xtics out nomirror\nset ytics out nomirror\n";
}

/// Pixels and lines of a view.
std::string plot_text(const Scene& scene, const PaintedView& painted, const std::optional<ColourBar>& membrane,
                      const Panel& panel, const fs::path& pixels) {
  const Window& window = panel.window;
  const double dx = window.width() / panel.pixels.width, dy = window.height() / panel.pixels.height;
  std::string data, plot = "plot " + gnuplot_text(pixels.string()) + " binary array=(" +
                           std::to_string(panel.pixels.width) + "," + std::to_string(panel.pixels.height) +
                           ") format='%uchar%uchar%uchar%uchar' origin=(" + format_number(window.lower[0] + 0.5 * dx) +
                           "," + format_number(window.lower[1] + 0.5 * dy) + ") dx=" + format_number(dx) +
                           " dy=" + format_number(dy) + " using 1:2:3:4 with rgbalpha notitle";
  const auto add = [&](const char* name, const std::string& points, const char* style) {
    if (points.empty()) return;
    data += std::string(name) + " << EOD\n" + points + "EOD\n";
    plot += std::string(", ") + name + " using 1:2 with " + style + " notitle";
  };
  const RigidLines rigid = rigid_lines(scene, painted.view.frame.rigid);
  add("$closed", rigid.closed, "lines linewidth 1.5 linecolor rgb '#202020'");
  add("$open", rigid.open, "lines linewidth 3 linecolor rgb '#202020'");
  add("$edges", rigid.edges, "lines linewidth 1.2 linecolor rgb '#404040'");
  if (scene.dimension == 3) {
    data += domain_data(scene.grid, painted.view.facing);
    plot += ", $domain using 1:2 with lines linewidth 1 dashtype 2 linecolor rgb '#909090' notitle";
  }
  if (membrane) {
    data += membrane_data(painted.view.frame.membranes, painted.tensions, *membrane);
    plot += ", $membranes using 1:2:3 with lines linewidth 2.5 linecolor rgb variable notitle";
  }
  return data + plot + "\n";
}

std::string bars_text(const PictureContent& content, const PictureLayout& layout) {
  int from = right_of(layout.panels.back()) + beside;
  std::string text;
  if (content.field) {
    text += bar_text(*content.field, layout, from, "$field");
    from += bar_place;
  }
  if (!content.legend.empty()) from += legend_place - 10;
  if (content.membrane) text += bar_text(*content.membrane, layout, from, "$tension");
  return text;
}

}  // namespace

std::string title_text(const std::string& title, const Panel& panel, const PictureLayout& layout) {
  constexpr double letter = 9;  // px, of the wider ones
  if (letter * static_cast<double>(title.size()) <= panel.pixels.width + 2.0 * left)
    return "set title " + gnuplot_text(title) + "\n";
  const auto of_a_line = static_cast<std::size_t>((layout.width - panel.left) / letter);
  std::size_t space = std::string::npos;
  if (title.size() > of_a_line) space = title.rfind(' ', std::min(of_a_line, title.rfind(" t = ")));
  std::string lines = gnuplot_text(title.substr(0, space));
  if (space != std::string::npos) lines += ".\"\\n\"." + gnuplot_text(title.substr(space + 1));
  const Shares at{layout};
  return "set title ''\nset label " + lines + " left at screen " + at.x(panel.left) + "," +
         at.y(layout.height - 0.35 * above) + "\n";
}

PictureLayout layout_of(const Extent& shown, const PictureContent& content) {
  std::vector<Window> windows;
  for (const PaintedView& painted : content.views) windows.push_back(window_of(shown, painted.view.facing));
  const double height = windows.front().height();  // of all: they have the same axis upwards
  double width = 0;
  for (const Window& window : windows) width += window.width();
  const double scale = std::min((windows.size() == 1 ? widest : widest_of_two) / width, highest / height);
  PictureLayout layout;
  double metre = 1e300;  // [px]
  for (const Window& window : windows) {
    const PixelSize pixels{std::max(least, static_cast<int>(scale * window.width())),
                           std::max(least, static_cast<int>(scale * height))};
    layout.panels.push_back({window, pixels, 0});
    metre = std::min({metre, pixels.width / window.width(), pixels.height / height});
  }
  // A narrow view is widened to the least size, so that a metre is as long in x as in y.
  for (Panel& panel : layout.panels) {
    for (std::size_t a = 0; a < 2; ++a) {
      const double pixels = a == 0 ? panel.pixels.width : panel.pixels.height;
      const double missing = pixels / metre - (panel.window.upper[a] - panel.window.lower[a]);
      panel.window.lower[a] -= 0.5 * missing;
      panel.window.upper[a] += 0.5 * missing;
    }
    panel.left = layout.width + left;
    layout.width = right_of(panel);
  }
  const int bars = (content.field ? 1 : 0) + (content.membrane ? 1 : 0);
  layout.width += beside + bars * bar_place + (content.legend.empty() ? 0 : legend_place);
  layout.height = below + layout.panels.front().pixels.height + above + (windows.size() > 1 ? heading : 0);
  return layout;
}

std::string page_opening(const std::string& terminal, const PictureLayout& layout, const fs::path& picture) {
  return "set encoding utf8\nset terminal " + terminal + " size " + std::to_string(layout.width) + "," +
         std::to_string(layout.height) + "\nset output " + gnuplot_text(picture.string()) +
         "\nset border linewidth 1\nset clip two\n";
}

std::string page_text(const Scene& scene, double t, const PictureContent& content, const PictureLayout& layout,
                      const std::vector<fs::path>& pixels) {
  const std::string title = scene.title + fmt::format(", t = {:.2f} s", t);
  const Shares at{layout};
  std::string text = "set multiplot\n" + legend_text(content.legend, layout);
  if (content.views.size() > 1)
    text += "set label " + gnuplot_text(title) + " center at screen " +
            at.x(0.5 * (layout.panels.front().left + right_of(layout.panels.back()))) + "," +
            at.y(layout.height - 0.5 * heading) + "\n";
  for (std::size_t v = 0; v < content.views.size(); ++v) {
    const PaintedView& painted = content.views[v];
    const Panel& panel = layout.panels[v];
    text += at.margins(panel.left, right_of(panel)) +
            title_text(painted.view.title.empty() ? title : painted.view.title, panel, layout) +
            axes_text(painted, panel) + plot_text(scene, painted, content.membrane, panel, pixels[v]) +
            "unset object\nunset label\n";
  }
  return text + bars_text(content, layout) + "unset multiplot\n";
}

}  // namespace geodrop
