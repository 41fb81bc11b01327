#include "history_chart.hpp"

#include <algorithm>
#include <cmath>

#include "panel_unit.hpp"

namespace geodrop {
namespace {

enum class Measure { value, change };  ///< as it is, or since the first row

/// The columns that a panel shows: their names begin so and end in one of these, the unit stripped in the legend.
struct Kind {
  std::string title, quantity, unit, beginning, unit_ending;
  std::vector<std::string> endings;
  Measure measure;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"Position", "position", "m", "", "_m", {".position_x_m", ".position_y_m", ".position_z_m"}, Measure::value},
      {"Velocity",
       "velocity",
       "m/s",
       "",
       "_m_s",
       {".velocity_x_m_s", ".velocity_y_m_s", ".velocity_z_m_s"},
       Measure::value},
      {"Membrane tension",
       "tension",
       "N/m",
       "",
       "_N_m",
       {".tension_max_N_m", ".tension_gauge_N_m", ".tension_mean_N_m", ".cross_tension_mean_N_m"},
       Measure::value},
      // Of a deep basin all would be flat lines beside its potential energy.
      {"Energy since the start", "change of energy", "J", "energy.", "_J", {"_J"}, Measure::change}};
  return all;
}

bool shows(const Kind& kind, const std::string& column) {
  return column.starts_with(kind.beginning) &&
         std::any_of(kind.endings.begin(), kind.endings.end(),
                     [&](const std::string& ending) { return column.ends_with(ending); });
}

struct Range {
  double low = 0, high = 0;
  double span() const { return high - low; }
  bool is_some() const { return low <= high; }
};

/// From the least to the largest finite value; low above high if there is none.
Range range_of(const std::vector<double>& values) {
  Range range{1, 0};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    range = range.is_some() ? Range{std::min(range.low, value), std::max(range.high, value)} : Range{value, value};
  }
  return range;
}

/// A line of a panel and the column that it shows.
struct Line {
  std::string column;
  ChartSeries series;
  double origin = 0;  ///< what is subtracted from the column

  double span() const { return std::max(0.0, range_of(series.y).span()); }
};

Line line_of(const CsvTable& table, const std::string& column, const Kind& kind) {
  const std::size_t begin = kind.beginning.size();
  Line line{column,
            {column.substr(begin, column.size() - kind.unit_ending.size() - begin), table.column("time_s"),
             table.column(column)},
            0};
  if (kind.measure == Measure::value) return line;
  line.origin = line.series.y.front();
  for (double& value : line.series.y) value -= line.origin;
  return line;
}

/// A panel before it is drawn.
struct Lines {
  const Kind* kind;
  std::vector<Line> moving;
};

/// "position_x of water, bed; velocity_x of bed", by the labels "water.position_x", ...
class NamesByQuantity {
 public:
  void add(const std::string& label) {
    const std::size_t dot = label.rfind('.');
    const std::string quantity = label.substr(dot + 1), of = dot == std::string::npos ? "" : label.substr(0, dot);
    const auto found = std::ranges::find(groups_, quantity, &Group::quantity);
    if (found == groups_.end())
      groups_.push_back({quantity, of});
    else
      found->of += ", " + of;
  }
  std::string text() const {
    std::string text;
    for (const Group& group : groups_)
      text += (text.empty() ? "" : "; ") + group.quantity + (group.of.empty() ? "" : " of " + group.of);
    return text;
  }

 private:
  struct Group {
    std::string quantity, of;
  };
  std::vector<Group> groups_;
};

/// "membrane energy" of "membrane" in the panel of energies.
std::string name_of(const Line& line, const Kind& kind) {
  return line.series.label + (kind.beginning.empty() ? "" : " energy");
}

/// Three of some 350 pixels, where the line that moves most goes from the bottom of a panel to its top.
constexpr double too_small_to_see = 3.0 / 350;

double largest_span(const std::vector<Line>& lines) {
  double most = 0;
  for (const Line& line : lines) most = std::max(most, line.span());
  return most;
}

void take_out_still(Lines& lines, NamesByQuantity& still) {
  const double least = too_small_to_see * largest_span(lines.moving);
  std::erase_if(lines.moving, [&](const Line& line) {
    const bool is_still = line.span() <= least;
    if (is_still) still.add(name_of(line, *lines.kind));
    return is_still;
  });
}

bool coincide(const std::vector<double>& a, const std::vector<double>& b, double distance) {
  return std::ranges::equal(a, b, [&](double y, double z) { return std::abs(y - z) <= distance; });
}

/// Lines that an earlier one covers, such as those of the water in the pores of a body.
void take_out_covered(Lines& lines, NamesByQuantity& covered) {
  const double distance = too_small_to_see * largest_span(lines.moving);
  std::vector<Line> seen;
  for (const Line& line : lines.moving)
    if (std::ranges::none_of(seen, [&](const Line& each) { return coincide(each.series.y, line.series.y, distance); }))
      seen.push_back(line);
    else
      covered.add(name_of(line, *lines.kind));
  lines.moving = seen;
}

Range range_of(const std::vector<Line>& lines) {
  std::vector<double> all;
  for (const Line& line : lines) all.insert(all.end(), line.series.y.begin(), line.series.y.end());
  return range_of(all);
}

/// Adds the references of the lines; names those that would press the lines into less than a third of the height.
void add_references(const std::vector<ReferenceLine>& references, const std::vector<Line>& lines, ChartPanel& panel,
                    std::string& far) {
  constexpr double least_share = 1.0 / 3;
  const Range shown = range_of(lines);
  for (const ReferenceLine& reference : references) {
    const auto line = std::ranges::find(lines, reference.column, &Line::column);
    if (line == lines.end()) continue;
    const std::vector<double>& time = line->series.x;
    const double from = std::max(reference.from, time.front()), to = std::min(reference.to, time.back());
    const double value = reference.value - line->origin;
    if (from > to) continue;
    if (shown.span() < least_share * (std::max(shown.high, value) - std::min(shown.low, value))) {
      far += (far.empty() ? "" : "; ") + reference.name;
      continue;
    }
    const bool is_short = to - from < time.back() - time.front();
    panel.series.push_back(
        {reference.name, {from, to}, {value, value}, is_short ? SeriesStyle::marked_line : SeriesStyle::dashed});
  }
}

}  // namespace

Chart history_chart(const CsvTable& table, const std::string& title, const std::vector<ReferenceLine>& references) {
  std::vector<Lines> all;
  NamesByQuantity still, covered;
  for (const Kind& kind : kinds()) {
    Lines lines{&kind, {}};
    for (const std::string& name : table.names)
      if (shows(kind, name)) lines.moving.push_back(line_of(table, name, kind));
    all.push_back(lines);
  }
  const bool all_still = std::ranges::all_of(all, [](const Lines& lines) {
    return std::ranges::all_of(lines.moving, [](const Line& l) { return l.span() == 0; });
  });
  Chart chart{title, {}, 2};
  std::string far;
  for (Lines& lines : all) {
    if (!all_still) take_out_still(lines, still);  // else nothing would be left
    take_out_covered(lines, covered);
    if (lines.moving.empty()) continue;
    ChartPanel panel{lines.kind->title, "time [s]", "", {}};
    for (const Line& line : lines.moving) panel.series.push_back(line.series);
    add_references(references, lines.moving, panel, far);
    set_y_unit(panel, lines.kind->quantity, lines.kind->unit);
    chart.panels.push_back(panel);
  }
  const auto note = [&](const std::string& what, const std::string& names) {
    if (!names.empty()) chart.notes.push_back(what + ": " + names);
  };
  note("not drawn, as they hardly move", still.text());
  note("not drawn, as others cover them", covered.text());
  note("beyond the scale", far);
  return chart;
}

}  // namespace geodrop
