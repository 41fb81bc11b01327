// The picture has places in pixels: the plane with equal scales on the left, legend or bars of colours on the right.
#include "snapshot_picture.hpp"

#include <geodrop/base/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "base/atomic_file.hpp"
#include "base/nearest_name.hpp"
#include "base/text.hpp"
#include "figures.hpp"
#include "files/read_frames.hpp"
#include "picture_values.hpp"
#include "plot/chart.hpp"

#include <geodrop/measure/measure.hpp>

namespace geodrop {
namespace {

namespace fs = std::filesystem;

// Places in pixels.
constexpr int left = 80, below = 64, above = 44, widest = 1040, highest = 760, least = 220;
constexpr int bar_width = 22, bar_place = 136, legend_place = 190;

/// A scale of colours with its bar.
struct Bar {
  ColourScale scale = ColourScale::viridis;
  ValueRange range;  ///< in SI units
  Scaled unit;
  std::string label;

  Colour colour(double value) const { return colour_at(scale, (value - range.first) / (range.second - range.first)); }
};

/// Everything that a page of gnuplot needs besides the pixels.
struct Layout {
  Window window;
  PixelSize pixels;           ///< of the plane
  int width = 0, height = 0;  ///< of the picture [px]

  std::string x(double at) const { return format_number(at / width, 6); }
  std::string y(double at) const { return format_number(at / height, 6); }
  /// Margins of a plot from and to these pixels, counted from the left and from below.
  std::string margins(double from, double to, double bottom, double top) const {
    return "set lmargin at screen " + x(from) + "\nset rmargin at screen " + x(to) + "\nset bmargin at screen " +
           y(bottom) + "\nset tmargin at screen " + y(top) + "\n";
  }
};

bool is_plane_without_end(const Scene& scene, std::uint32_t rigid) {
  return rigid < scene.rigid.size() && std::holds_alternative<HalfPlaneShape>(scene.rigid[rigid].shape);
}

Window whole_window(const Scene& scene, const Snapshot& snapshot) {
  Window window{{1e300, 1e300}, {-1e300, -1e300}};
  const auto add = [&](const std::vector<double>& points, std::size_t i) {
    for (std::size_t a = 0; a < 2; ++a) {
      window.lower[a] = std::min(window.lower[a], points[3 * i + a]);
      window.upper[a] = std::max(window.upper[a], points[3 * i + a]);
    }
  };
  for (std::size_t i = 0; 3 * i < snapshot.particles.points.size(); ++i) add(snapshot.particles.points, i);
  for (std::size_t i = 0; 3 * i < snapshot.membranes.points.size(); ++i) add(snapshot.membranes.points, i);
  for (std::size_t line = 0; line < snapshot.rigid.rigid.size(); ++line)
    if (!is_plane_without_end(scene, snapshot.rigid.rigid[line]))
      add(snapshot.rigid.points, snapshot.rigid.connectivity[2 * line]);
  const double margin = std::max(scene.grid.spacing, 0.02 * std::max(window.width(), window.height()));
  for (std::size_t a = 0; a < 2; ++a) {
    window.lower[a] -= margin;
    window.upper[a] += margin;
  }
  return window;
}

/// Without the outermost 0.5 % of the values at either end; about zero where they have both signs.
Bar bar_of(const PictureValues& shown, const std::optional<ValueRange>& asked) {
  constexpr double outer = 0.5, both_signs = 0.2;
  Bar bar;
  bar.range = asked.value_or(ValueRange{percentile(shown.values, outer), percentile(shown.values, 100 - outer)});
  auto& [low, high] = bar.range;
  if (!std::isfinite(low) || !std::isfinite(high)) low = 0, high = 1;
  const double size = std::max(std::abs(low), std::abs(high));
  if (!asked && low < 0 && high > 0 && std::min(-low, high) > both_signs * size) {
    bar.scale = ColourScale::difference;
    low = -size;
    high = size;
  }
  if (high - low < 1e-6 * size || high == low) {  // one value: its colour is in the middle
    const double half = size > 0 ? 0.05 * size : 1;
    low -= half;
    high += half;
  }
  bar.unit = scaled_unit(shown.unit, size);
  bar.label = shown.label;
  return bar;
}

Bar membrane_bar(const PictureValues& values, const std::optional<ValueRange>& asked) {
  double largest = 0;
  for (const double value : values.values)
    if (std::isfinite(value)) largest = std::max(largest, value);
  Bar bar;
  bar.scale = ColourScale::heat;
  bar.range = asked.value_or(ValueRange{0, largest > 0 ? largest : 1});
  bar.unit = scaled_unit(values.unit, bar.range.second);
  bar.label = values.label;
  return bar;
}

/// The inside of the closed membrane around each body; empty where there is none.
std::vector<Mask> masks_of(const Scene& scene, const MembraneSnapshot& membranes, const Layout& layout) {
  std::vector<Mask> masks(scene.bodies.size());
  for (std::size_t m = 0; m < scene.membranes.size(); ++m) {
    const auto body = std::ranges::find(scene.bodies, scene.membranes[m].body, &BodySpec::name);
    std::vector<std::array<double, 4>> ends;
    for (std::size_t s = 0; s < membranes.membrane.size(); ++s) {
      if (membranes.membrane[s] != m) continue;
      const double *from = &membranes.points[3 * membranes.connectivity[2 * s]],
                   *to = &membranes.points[3 * membranes.connectivity[2 * s + 1]];
      ends.push_back({from[0], from[1], to[0], to[1]});
    }
    if (scene.membranes[m].closed && !ends.empty() && body != scene.bodies.end())
      masks[static_cast<std::size_t>(body - scene.bodies.begin())] = inside_of(ends, layout.window, layout.pixels);
  }
  return masks;
}

std::vector<Disc> discs_of(const Scene& scene, const ParticleSnapshot& particles, const std::vector<Colour>& colours,
                           const std::vector<Mask>& masks) {
  constexpr double reach = 0.72;  // of the spacing of particles; 0.707 fill a square lattice
  std::vector<double> radius;
  for (const BodySpec& body : scene.bodies) radius.push_back(reach * scene.grid.spacing / body.particles_per_cell_axis);
  std::vector<Disc> discs;
  std::vector<bool> hidden;
  for (const BodySpec& body : scene.bodies) hidden.push_back(lies_in_pores(scene, body));
  for (std::size_t p = 0; p < colours.size(); ++p) {
    if (hidden.at(particles.body[p])) continue;
    const Mask& mask = masks.at(particles.body[p]);
    discs.push_back({{particles.points[3 * p], particles.points[3 * p + 1]},
                     radius[particles.body[p]],
                     colours[p],
                     mask.empty() ? nullptr : &mask});
  }
  return discs;
}

std::string point_text(const std::vector<double>& points, std::size_t i) {
  return format_number(points[3 * i]) + " " + format_number(points[3 * i + 1]);
}

/// Lines of two points each, with their colours.
std::string membrane_data(const MembraneSnapshot& membranes, const std::vector<double>& values, const Bar& bar) {
  std::string text = "$membranes << EOD\n";
  for (std::size_t s = 0; s < values.size(); ++s) {
    const std::string colour = " " + std::to_string(rgb(bar.colour(values[s]))) + "\n";
    for (const std::size_t end : {2 * s, 2 * s + 1})
      text += point_text(membranes.points, membranes.connectivity[end]) + colour;
    text += "\n";
  }
  return text + "EOD\n";
}

/// Outlines of rigid bodies: closed ones to be filled, boundaries of half-planes to be drawn.
struct RigidLines {
  std::string closed, open;
};
RigidLines rigid_lines(const Scene& scene, const RigidSnapshot& rigid) {
  RigidLines lines;
  for (std::size_t first = 0, end = 0; first < rigid.rigid.size(); first = end) {
    std::string text;
    for (; end < rigid.rigid.size() && rigid.rigid[end] == rigid.rigid[first]; ++end)
      text += point_text(rigid.points, rigid.connectivity[2 * end]) + "\n";
    text += point_text(rigid.points, rigid.connectivity[2 * end - 1]) + "\n\n";
    (is_plane_without_end(scene, rigid.rigid[first]) ? lines.open : lines.closed) += text;
  }
  return lines;
}

/// The colours of a bar as a picture of its own, numbers on its right.
std::string bar_text(const Bar& bar, const Layout& layout, int place, const std::string& name) {
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
  const double from = left + layout.pixels.width + 26 + place * bar_place;
  const std::string unit = bar.unit.unit.empty() ? "-" : bar.unit.unit;
  return data + "EOD\n" + layout.margins(from, from + bar_width, below, below + layout.pixels.height) +
         "set title ''\nset xlabel ''\nset ylabel ''\nunset xtics\nunset ytics\nset y2tics format '% .4g' out\n"
         "set y2label " +
         gnuplot_text(bar.label + " [" + unit + "]") + " offset character 0,0\nset xrange [-0.5:1.5]\nset y2range [" +
         format_number(low) + ":" + format_number(high) + "]\nset yrange [" + format_number(low) + ":" +
         format_number(high) + "]\nplot " + name + " using 1:2:3:4:5 with rgbimage notitle\n" +
         "unset y2tics\nset y2label ''\nset xtics\nset ytics\n";
}

/// Squares and names on the right of the plane, from the top.
std::string legend_text(const std::vector<LegendEntry>& legend, const Layout& layout) {
  constexpr int square = 16, line = 24;
  std::string text;
  const double x = left + layout.pixels.width + 20;
  double y = below + layout.pixels.height - square;
  for (const LegendEntry& entry : legend) {
    const bool beside = entry.name.empty();  // the second colour of the entry before
    if (beside) y += line;
    const double from = x + (beside ? square : 0);
    std::array<char, 16> colour;
    std::snprintf(colour.data(), colour.size(), "#%06x", static_cast<unsigned>(rgb(entry.colour)));
    text += "set object rectangle from screen " + layout.x(from) + "," + layout.y(y) + " to screen " +
            layout.x(from + square) + "," + layout.y(y + square) + " fillcolor rgb '" + colour.data() +
            "' fillstyle solid noborder\n";
    if (!beside)
      text += "set label " + gnuplot_text(entry.name) + " at screen " + layout.x(x + 2 * square + 8) + "," +
              layout.y(y + square / 2.0) + "\n";
    y -= line;
  }
  return text;
}

/// What a frame shows, with the scales that it needs.
struct Content {
  std::vector<Colour> colours;
  std::vector<LegendEntry> legend;
  std::vector<double> tensions;  ///< or another field of the membranes
  std::optional<Bar> field, membrane;
};

Content content_of(const Scene& scene, const Snapshot& snapshot, const PictureOptions& options) {
  Content content;
  if (options.field == "layers" || options.field == "material") {
    Categories categories =
        options.field == "layers" ? layers_of(scene, snapshot.particles) : materials_of(scene, snapshot.particles);
    content.colours = std::move(categories.colours);
    content.legend = std::move(categories.legend);
  } else {
    const PictureValues values = values_of(snapshot.particles.fields, options.field);
    content.field = bar_of(values, options.range);
    for (const double value : values.values) content.colours.push_back(content.field->colour(value));
  }
  if (options.membrane == "none" || snapshot.membranes.membrane.empty()) return content;
  const PictureValues values = values_of(snapshot.membranes.fields, options.membrane);
  content.membrane = membrane_bar(values, options.tensions);
  content.tensions = values.values;
  return content;
}

Layout layout_of(const Window& window, const Content& content) {
  Layout layout{window, {}, 0, 0};
  const double scale = std::min(widest / window.width(), highest / window.height());
  layout.pixels = {std::max(least, static_cast<int>(scale * window.width())),
                   std::max(least, static_cast<int>(scale * window.height()))};
  // A narrow plane is widened to the least size, so that a metre is as long in x as in y.
  const double metre = std::min(layout.pixels.width / window.width(), layout.pixels.height / window.height());
  for (std::size_t a = 0; a < 2; ++a) {
    const double pixels = a == 0 ? layout.pixels.width : layout.pixels.height;
    const double missing = pixels / metre - (window.upper[a] - window.lower[a]);
    layout.window.lower[a] -= 0.5 * missing;
    layout.window.upper[a] += 0.5 * missing;
  }
  const int bars = (content.field ? 1 : 0) + (content.membrane ? 1 : 0);
  layout.width = left + layout.pixels.width + 26 + bars * bar_place + (content.legend.empty() ? 0 : legend_place);
  layout.height = below + layout.pixels.height + above;
  return layout;
}

/// The plane with its pixels, lines and axes, then the bars.
std::string page_text(const Scene& scene, const Snapshot& snapshot, const Content& content, const Layout& layout,
                      const fs::path& pixels) {
  const Window& window = layout.window;
  const double dx = window.width() / layout.pixels.width, dy = window.height() / layout.pixels.height;
  const auto range = [](double low, double high) { return "[" + format_number(low) + ":" + format_number(high) + "]"; };
  std::array<char, 32> time;
  std::snprintf(time.data(), time.size(), "t = %.2f s", snapshot.t);
  const RigidLines rigid = rigid_lines(scene, snapshot.rigid);
  std::string text =
      "set multiplot\n" + layout.margins(left, left + layout.pixels.width, below, below + layout.pixels.height);
  text += legend_text(content.legend, layout);
  text += "set title " + gnuplot_text(scene.title + ", " + time.data()) +
          "\nset xlabel 'x [m]'\nset ylabel 'y [m]'\nset xrange " + range(window.lower[0], window.upper[0]) +
          "\nset yrange " + range(window.lower[1], window.upper[1]) +
          "\nset xtics out nomirror\nset ytics out nomirror\n";
  if (!rigid.closed.empty()) text += "$closed << EOD\n" + rigid.closed + "EOD\n";
  if (!rigid.open.empty()) text += "$open << EOD\n" + rigid.open + "EOD\n";
  if (content.membrane) text += membrane_data(snapshot.membranes, content.tensions, *content.membrane);
  text += "plot " + gnuplot_text(pixels.string()) + " binary array=(" + std::to_string(layout.pixels.width) + "," +
          std::to_string(layout.pixels.height) + ") format='%uchar%uchar%uchar%uchar' origin=(" +
          format_number(window.lower[0] + 0.5 * dx) + "," + format_number(window.lower[1] + 0.5 * dy) +
          ") dx=" + format_number(dx) + " dy=" + format_number(dy) + " using 1:2:3:4 with rgbalpha notitle";
  if (!rigid.closed.empty())
    text +=
        ", $closed using 1:2 with filledcurves closed fillstyle solid noborder linecolor rgb '#b8b8b8' notitle"
        ", $closed using 1:2 with lines linewidth 1.5 linecolor rgb '#202020' notitle";
  if (!rigid.open.empty()) text += ", $open using 1:2 with lines linewidth 3 linecolor rgb '#202020' notitle";
  if (content.membrane) text += ", $membranes using 1:2:3 with lines linewidth 2.5 linecolor rgb variable notitle";
  text += "\nunset object\nunset label\n";
  int place = 0;
  if (content.field) text += bar_text(*content.field, layout, place++, "$field");
  if (content.membrane) {
    Layout shifted = layout;
    shifted.pixels.width += content.legend.empty() ? 0 : legend_place - 10;
    text += bar_text(*content.membrane, shifted, place, "$tension");
  }
  return text + "unset multiplot\n";
}

std::string opening(const std::string& terminal, const Layout& layout, const fs::path& picture) {
  return "set encoding utf8\nset terminal " + terminal + " size " + std::to_string(layout.width) + "," +
         std::to_string(layout.height) + "\nset output " + gnuplot_text(picture.string()) +
         "\nset border linewidth 1\n";
}

/// A file of pixels beside the picture, which goes with its owner.
class PixelFile {
 public:
  PixelFile(fs::path path, const std::string& pixels) : path_(std::move(path)) { write_file_atomically(path_, pixels); }
  PixelFile(const PixelFile&) = delete;
  PixelFile& operator=(const PixelFile&) = delete;
  ~PixelFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string pixels_of(const Scene& scene, const Snapshot& snapshot, const Content& content, const Layout& layout) {
  const std::vector<Mask> masks = masks_of(scene, snapshot.membranes, layout);
  return draw_discs(discs_of(scene, snapshot.particles, content.colours, masks), layout.window, layout.pixels);
}

}  // namespace

std::vector<std::string> picture_fields(const Snapshot& snapshot) {
  std::vector<std::string> names{"layers", "material"};
  const std::vector<std::string> values = value_names(snapshot.particles.fields);
  names.insert(names.end(), values.begin(), values.end());
  return names;
}

void check_picture(const Scene& scene, const Snapshot& snapshot, const PictureOptions& options) {
  const auto refuse = [&](const std::string& option, const std::string& found, const std::string& allowed) {
    throw SceneError("geodrop snapshot", {{{}, option, found, allowed, ProblemSource::elsewhere}});
  };
  if (scene.dimension != 2) refuse("", "a scene in space", "a scene of the plane (in space: paraview/show_run.py)");
  const auto check = [&](const std::string& option, const std::string& name, const std::vector<std::string>& known) {
    if (std::ranges::find(known, name) == known.end())
      refuse(option, '"' + name + '"', name_advice(name, known, "fields"));
  };
  check("--field", options.field, picture_fields(snapshot));
  std::vector<std::string> membrane{"none"};
  const std::vector<std::string> values = value_names(snapshot.membranes.fields);
  membrane.insert(membrane.end(), values.begin(), values.end());
  if (!snapshot.membranes.fields.empty()) check("--membrane", options.membrane, membrane);
}

void draw_snapshot(const Scene& scene, const Snapshot& snapshot, const PictureOptions& options, const fs::path& file) {
  check_picture(scene, snapshot, options);
  const Content content = content_of(scene, snapshot, options);
  const Layout layout = layout_of(options.window.value_or(whole_window(scene, snapshot)), content);
  const PixelFile pixels(file.string() + ".pixels", pixels_of(scene, snapshot, content, layout));
  draw_by_gnuplot(file, [&](const fs::path& picture) {
    return opening("pngcairo noenhanced font 'sans,12' background rgb 'white'", layout, picture) +
           page_text(scene, snapshot, content, layout, fs::absolute(pixels.path())) + "unset output\n";
  });
}

void draw_animation(const Scene& scene, const fs::path& directory, const std::vector<std::size_t>& frames,
                    PictureOptions options, const fs::path& file) {
  constexpr std::chrono::seconds patience_for_each{4};
  const bool range_given = options.range.has_value(), tensions_given = options.tensions.has_value();
  // Scales of the first, the middle and the last frame together, window of the first.
  for (const std::size_t index : {frames.front(), frames[frames.size() / 2], frames.back()}) {
    const Snapshot snapshot = read_frame(directory, index);
    check_picture(scene, snapshot, options);
    const Content content = content_of(scene, snapshot, {options.field, options.membrane, {}, {}, {}});
    const auto join = [](std::optional<ValueRange>& range, const std::optional<Bar>& bar, bool given) {
      if (!bar || given) return;
      range = range ? ValueRange{std::min(range->first, bar->range.first), std::max(range->second, bar->range.second)}
                    : bar->range;
    };
    join(options.range, content.field, range_given);
    join(options.tensions, content.membrane, tensions_given);
    if (!options.window) options.window = whole_window(scene, snapshot);
  }
  std::deque<PixelFile> pixels;
  std::string pages, first;
  draw_by_gnuplot(
      file,
      [&](const fs::path& picture) {
        for (const std::size_t index : frames) {
          const Snapshot snapshot = read_frame(directory, index);
          const Content content = content_of(scene, snapshot, options);
          const Layout layout = layout_of(*options.window, content);
          pixels.emplace_back(file.string() + "." + std::to_string(index) + ".pixels",
                              pixels_of(scene, snapshot, content, layout));
          if (first.empty()) first = opening("gif noenhanced animate delay 10 loop 0 font 'sans,11'", layout, picture);
          pages += page_text(scene, snapshot, content, layout, fs::absolute(pixels.back().path()));
        }
        return first + pages + "unset output\n";
      },
      patience_for_each * static_cast<int>(frames.size() + 8));
}

}  // namespace geodrop
