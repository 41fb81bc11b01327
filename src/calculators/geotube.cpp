// A tube from one quantity: a root over the tension, on which all others rise; and what lies outside all tubes.
#include <geodrop/base/error.hpp>
#include <geodrop/calculators/geotube.hpp>

#include "base/text.hpp"
#include "find_root.hpp"
#include "membrane_path.hpp"
#include "tube_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace geodrop {
namespace {

constexpr double pi = std::numbers::pi;

double stretched_length(const GeotubeInput& tube, double tension) {
  return tube.perimeter * (1 + tension / tube.stiffness);
}

std::optional<TubeShape> shape_of_tension(const GeotubeInput& tube, double tension) {
  return find_shape({tube.unit_weight, tube.water}, stretched_length(tube, tension), tension);
}

// --- The tension that belongs to a quantity --------------------------------------------------------------------------

struct Quantity {
  const char* name;
  const char* unit;
};

Quantity name_of(GeotubeQuantity quantity) {
  switch (quantity) {
    case GeotubeQuantity::area:
      return {"area", "m2"};
    case GeotubeQuantity::height:
      return {"height", "m"};
    case GeotubeQuantity::top_pressure:
      return {"pressure", "Pa"};
    case GeotubeQuantity::tension:
      break;
  }
  return {"tension", "N/m"};
}

double quantity_of(const TubeShape& shape, GeotubeQuantity quantity) {
  switch (quantity) {
    case GeotubeQuantity::area:
      return shape.section.area;
    case GeotubeQuantity::height:
      return shape.load.height;
    case GeotubeQuantity::top_pressure:
      return shape.load.top_pressure;
    case GeotubeQuantity::tension:
      break;
  }
  return shape.load.tension;
}

[[noreturn]] void refuse(const std::string& key, const std::string& found, const std::string& allowed) {
  throw SceneError("geotube", {{{}, key, found, allowed, ProblemSource::elsewhere}});
}

struct Range {
  double low, high;
};

/// Tensions of the flattest and of the fullest tube that are computed.
Range tension_range(const GeotubeInput& tube) {
  constexpr double flattest = 2e-7;  // of gamma L^2: p_top / p_bottom then is 1e-243, the height 0.0009 L
  constexpr double fullest = 1e9;    // of gamma L^2: the area then is the circle's to 16 digits
  const double square = tube.perimeter * tube.perimeter;
  const double lowest_height = 2 * std::sqrt(flattest) * tube.perimeter;
  const double under_water = tube.unit_weight - tube.water.unit_weight;
  const bool is_submerged = tube.water.level > lowest_height && under_water > 0;
  const Range range{flattest * (is_submerged ? under_water : tube.unit_weight) * square,
                    std::min(fullest * tube.unit_weight * square, tube.stiffness)};
  if (range.low >= range.high)
    refuse(
        "stiffness", format_number(tube.stiffness),
        "more than " + format_number(range.low) + " N/m: softer, it stretches to twice its length when nearly empty");
  return range;
}

/// The circle's, which a tube of finite tension falls short of; or at strain 1.
std::string upper_limit(const GeotubeInput& tube, double tension, double most) {
  const Quantity quantity = name_of(tube.given);
  const std::string unit = std::string(" ") + quantity.unit, fullest = format_number(most) + unit;
  if (tension >= tube.stiffness) return "less than " + fullest + ", where the membrane's strain is 1";
  if (tube.given == GeotubeQuantity::area)
    return "less than " + format_number(tube.perimeter * tube.perimeter / (4 * pi)) + unit + ", the area of the circle";
  if (tube.given == GeotubeQuantity::height)
    return "less than " + format_number(tube.perimeter / pi) + unit + ", the diameter of the circle";
  return "less than " + fullest + ", where the tube is a circle to 16 digits";
}

/// A tube that floats is one that is not full enough: full ones stand out of the water.
double tension_where(const GeotubeInput& tube, const Range& range) {
  const auto difference = [&](double log_tension) {
    const std::optional<TubeShape> shape = shape_of_tension(tube, std::exp(log_tension));
    return shape ? std::log(quantity_of(*shape, tube.given) / tube.value) : -1;
  };
  return std::exp(find_root(difference, std::log(range.low), std::log(range.high)));
}

/// The pressure at the crown falls for a while when the crown of a flat tube rises out of the water. Up to the pressure
/// of the tube that is as high as the water the answer is the submerged tube, above it the only one there is.
Range narrow_for_pressure(const GeotubeInput& tube, const Range& range) {
  GeotubeInput level_tube = tube;
  level_tube.given = GeotubeQuantity::height;
  level_tube.value = tube.water.level;
  const std::optional<TubeShape> fullest = shape_of_tension(tube, range.high);
  const std::optional<TubeShape> flattest = shape_of_tension(tube, range.low);
  if (!flattest || flattest->load.height >= tube.water.level || fullest->load.height <= tube.water.level) return range;
  const double tension = tension_where(level_tube, range);
  const bool is_above = tube.value > shape_of_tension(tube, tension)->load.top_pressure;
  return is_above ? Range{tension, range.high} : Range{range.low, tension};
}

/// Empty if the tube floats; refuses what is out of reach.
std::optional<TubeShape> reach(const GeotubeInput& tube) {
  const Range range = tension_range(tube);
  const std::optional<TubeShape> fullest = shape_of_tension(tube, range.high);
  if (!fullest) return std::nullopt;
  const Quantity quantity = name_of(tube.given);
  const double most = quantity_of(*fullest, tube.given);
  if (tube.value >= most) refuse(quantity.name, format_number(tube.value), upper_limit(tube, range.high, most));
  const std::optional<TubeShape> flattest = shape_of_tension(tube, range.low);
  const double least = flattest ? quantity_of(*flattest, tube.given) : 0;
  if (tube.value <= least) {
    // A fill that is not heavier than the water rests as long as it is high enough; less of it is all below the water.
    if (tube.water.level > 0 && tube.unit_weight <= tube.water.unit_weight) return std::nullopt;
    refuse(quantity.name, format_number(tube.value),
           "more than " + format_number(least) + " " + quantity.unit + "; flatter tubes are not computed");
  }
  if (tube.given == GeotubeQuantity::tension) return shape_of_tension(tube, tube.value);
  const bool is_ambiguous = tube.given == GeotubeQuantity::top_pressure && tube.water.level > 0;
  const double tension = tension_where(tube, is_ambiguous ? narrow_for_pressure(tube, range) : range);
  const std::optional<TubeShape> shape = shape_of_tension(tube, tension);
  constexpr double right = 1e-8;  // else the root is the jump between tubes that float and tubes that are fuller
  const bool is_found = shape && std::abs(quantity_of(*shape, tube.given) / tube.value - 1) < right;
  return is_found ? shape : std::nullopt;
}

// --- The whole tube --------------------------------------------------------------------------------------------------

void check_positive(const char* name, double value, const std::string& allowed) {
  if (!(value > 0 && std::isfinite(value))) refuse(name, format_number(value), allowed);
}

void check(const GeotubeInput& tube) {
  check_positive("perimeter", tube.perimeter, "a length > 0 [m]");
  check_positive("unit-weight", tube.unit_weight, "a unit weight > 0 [N/m3]");
  if (!(tube.stiffness > 0)) refuse("stiffness", format_number(tube.stiffness), "an axial stiffness > 0 [N/m]");
  const Quantity quantity = name_of(tube.given);
  check_positive(quantity.name, tube.value, std::string("a value > 0 [") + quantity.unit + "]");
  if (!(tube.water.level >= 0 && std::isfinite(tube.water.level)))
    refuse("water-level", format_number(tube.water.level), "a height above the ground >= 0 [m]");
  if (tube.water.level > 0) check_positive("water-unit-weight", tube.water.unit_weight, "a unit weight > 0 [N/m3]");
}

/// The highest water that the tube does not float in.
[[noreturn]] void refuse_floating(const GeotubeInput& tube) {
  GeotubeInput dry = tube;
  dry.water = {};
  reach(dry);  // which refuses what is impossible without any water, too
  double rests = 0, floats = tube.water.level;
  constexpr int halvings = 30;  // to 1e-9 of the level
  for (int i = 0; i < halvings; ++i) {
    GeotubeInput lower = tube;
    lower.water.level = (rests + floats) / 2;
    (reach(lower) ? rests : floats) = lower.water.level;
  }
  refuse("water-level", format_number(tube.water.level),
         "at most " + format_number(rests) + " m, above which this tube floats");
}

Geotube whole_tube(const GeotubeInput& tube, const TubeShape& shape) {
  const auto& [load, section] = shape;
  const PathPoint widest = MembranePath(load).where_upright();
  const double length = stretched_length(tube, load.tension), water = tube.water.unit_weight;
  const double level = tube.water.level, cover = std::max(0.0, level - load.height);
  return {.perimeter = tube.perimeter,
          .unit_weight = tube.unit_weight,
          .water = tube.water,
          .area = section.area,
          .height = load.height,
          .width = 2 * widest.x,
          .width_level = load.height - widest.y,
          .base_width = 2 * section.half_base,
          .length = length,
          .strain = load.tension / tube.stiffness,
          .top_pressure = load.top_pressure,
          .bottom_pressure = load.bottom_pressure,
          .tension = load.tension,
          .fill_pressure_top = load.top_pressure + (level > 0 ? water * cover : 0),
          .fill_pressure_bottom = load.bottom_pressure + (level > 0 ? water * level : 0)};
}

}  // namespace

std::optional<Geotube> find_geotube(const GeotubeInput& input) {
  check(input);
  const std::optional<TubeShape> shape = reach(input);
  return shape ? std::optional(whole_tube(input, *shape)) : std::nullopt;
}

Geotube solve_geotube(const GeotubeInput& input) {
  const std::optional<Geotube> tube = find_geotube(input);
  if (!tube) refuse_floating(input);
  return *tube;
}

std::vector<OutlinePoint> geotube_outline(const Geotube& tube, int segments) {
  const MembranePath path(find_load({tube.unit_weight, tube.water}, tube.top_pressure, tube.tension));
  std::vector<OutlinePoint> points;
  for (int i = 0; i <= segments; ++i) {
    const double s = tube.length * i / segments;
    const bool is_left = 2 * i > segments;
    const double way = is_left ? tube.length - s : s;  // from the crown, on either side
    const bool is_base = way >= path.end().s;
    const PathPoint at = is_base ? path.end() : path.at(way);
    const double x = is_base ? tube.length / 2 - way : at.x;
    points.push_back({s, is_left ? -x : x, is_base ? 0 : tube.height - at.y, is_left ? 2 * pi - at.theta : at.theta,
                      is_base ? tube.bottom_pressure : at.pressure});
  }
  return points;
}

}  // namespace geodrop
