#include "doubtful_gaps.hpp"

#include <geodrop/geometry/shapes.hpp>

#include <algorithm>
#include <optional>

#include "base/text.hpp"
#include "contact/rigid_surface.hpp"
#include "contact/space_surface.hpp"
#include "open_fluid.hpp"
#include "scene/needs.hpp"
#include "setup/site_share.hpp"

namespace geodrop {
namespace {

std::string metres(double length) { return format_number(length, 3) + " m"; }

/// What is at a place.
struct Thing {
  enum class Kind { nothing, body, rigid, outside } kind = Kind::nothing;
  const BodySpec* body = nullptr;

  bool operator==(const Thing&) const = default;
  std::string name() const {
    if (kind == Kind::body) return '"' + body->name + '"';
    return kind == Kind::rigid ? "a rigid surface" : "the end of the domain";
  }
};

/// Answers what is where at the start of a scene.
class Places {
 public:
  explicit Places(const Scene& scene) : scene_(scene) {
    for (const BodySpec& body : scene.bodies) regions_.emplace_back(scene, body);
    for (const RigidSpec& rigid : scene.rigid) {
      if (scene.dimension == 3)
        in_space_.emplace_back(make_rigid_body(rigid));
      else if (!std::holds_alternative<HalfPlaneShape>(rigid.shape))
        in_plane_.emplace_back(make_rigid_body(rigid, scene.grid));
    }
  }

  Thing at(const Point& x) const {
    for (std::size_t a = 0; a < x.size(); ++a)
      if (x[a] < scene_.grid.lower[a] || x[a] > scene_.grid.upper[a]) return {Thing::Kind::outside};
    if (const BodySpec* const body = body_at(x)) return {Thing::Kind::body, body};
    return {is_rigid(x) ? Thing::Kind::rigid : Thing::Kind::nothing};
  }

 private:
  const BodySpec* body_at(const Point& x) const {
    const auto found = std::ranges::find_if(regions_, [&](const BodyRegion& region) { return region.holds(x); });
    return found == regions_.end() ? nullptr : &scene_.bodies[static_cast<std::size_t>(found - regions_.begin())];
  }

  /// In the plane also half a step beside a surface, so that no thin wall is stepped over.
  bool is_rigid(const Point& x) const {
    if (scene_.dimension == 3) {
      const Vec<3> at(x.data());
      return std::ranges::any_of(in_space_, [&](const SpaceSurface& each) { return each.depth(at).has_value(); });
    }
    const auto is_within = [&](const RigidSpec& rigid) {
      const auto* half = std::get_if<HalfPlaneShape>(&rigid.shape);
      return half && contains(*half, x);
    };
    const Vec<2> at(x.data());
    const double reach = 0.25 * scene_.grid.spacing;
    return std::ranges::any_of(scene_.rigid, is_within) ||
           std::ranges::any_of(in_plane_, [&](const RigidSurface& each) { return each.may_touch(at, at, reach); });
  }

  const Scene& scene_;
  std::vector<BodyRegion> regions_;  ///< of each body
  std::vector<RigidSurface> in_plane_;
  std::vector<SpaceSurface> in_space_;
};

/// Nothing between two things along an axis.
struct Gap {
  Thing before, after;
  Point place;              ///< on the line
  double from = 0, to = 0;  ///< along the axis [m]

  double size() const { return to - from; }
};

/// Lines along an axis of a scene.
struct Line {
  const Scene& scene;
  const Places& places;
  std::size_t axis;
  Point through;

  Thing at(double coordinate) const {
    Point x = through;
    x[axis] = coordinate;
    return places.at(x);
  }
  /// Between two coordinates at which different things are: where the first one ends.
  double end_of(double first, double second) const {
    const Thing there = at(first);
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (first + second);
      (at(middle) == there ? first : second) = middle;
    }
    return 0.5 * (first + second);
  }
  std::vector<Gap> gaps() const {
    const double step = 0.5 * scene.grid.spacing;
    std::vector<Gap> found;
    Thing last{Thing::Kind::outside}, before = last;
    double from = 0, previous = scene.grid.lower[axis] - 0.25 * step;
    for (double here = previous + step; previous < scene.grid.upper[axis]; previous = here, here += step) {
      const Thing thing = at(here);
      const bool is_empty = thing.kind == Thing::Kind::nothing;
      if (is_empty && last.kind != Thing::Kind::nothing) {
        before = last;
        from = end_of(previous, here);
      }
      if (!is_empty && last.kind == Thing::Kind::nothing)
        found.push_back({before, thing, through, from, end_of(previous, here)});
      last = thing;
    }
    return found;
  }
};

/// Through the middles of equal parts of the domain across an axis.
std::vector<Line> lines_along(const Scene& scene, const Places& places, std::size_t axis) {
  const auto dimension = static_cast<std::size_t>(scene.dimension);
  const int parts = dimension == 2 ? 40 : 12;
  std::vector<Line> lines{{scene, places, axis, scene.grid.lower}};
  for (std::size_t across = 0; across < dimension; ++across) {
    if (across == axis) continue;
    std::vector<Line> more;
    for (const Line& line : lines)
      for (int i = 0; i < parts; ++i) {
        more.push_back(line);
        more.back().through[across] += (i + 0.5) / parts * (scene.grid.upper[across] - scene.grid.lower[across]);
      }
    lines = std::move(more);
  }
  return lines;
}

bool is_placed_later(const Scene& scene, const BodySpec& body) {
  return std::ranges::any_of(scene.stages, [&](const StageSpec& stage) {
    return std::ranges::find(stage.places, body.name) != stage.places.end();
  });
}

bool moves_at_start(const BodySpec& body) {
  const auto* uniform = std::get_if<UniformVelocitySpec>(&body.initial_velocity);
  return !uniform || std::ranges::any_of(uniform->value, [](double v) { return v != 0; });
}

/// A fluid at rest that nothing holds together.
bool is_free(const Scene& scene, const Thing& thing) {
  return thing.body && fluid_of(scene, *thing.body) && !is_enclosed(scene, *thing.body) &&
         !moves_at_start(*thing.body) && !is_placed_later(scene, *thing.body) && thing.body->saturated_by.empty();
}

/// "at x = 1.2 m, y = 3 m"
std::string place_in_words(const Gap& gap, std::size_t axis) {
  std::string words;
  for (std::size_t a = 0; a < gap.place.size(); ++a)
    if (a != axis) words += (words.empty() ? "at " : ", ") + std::string(1, "xyz"[a]) + " = " + metres(gap.place[a]);
  return words;
}

/// Gaps that particles, two a cell, show.
double least_gap(const Scene& scene) { return 0.75 * scene.grid.spacing; }

std::string fall_in_words(const Scene& scene, const Gap& gap, std::size_t vertical) {
  if (!is_free(scene, gap.after) || gap.size() <= least_gap(scene)) return {};
  return gap.after.name() + " begins " + metres(gap.size()) + " above " + gap.before.name() + " (" +
         place_in_words(gap, vertical) + "): it will fall";
}

/// Wider gaps are meant: a dam break begins with one.
std::string flow_in_words(const Scene& scene, const Gap& gap, std::size_t axis) {
  constexpr double most_share = 0.1;  // of the extent of the fluid
  const bool is_before = is_free(scene, gap.before);
  if (!is_before && !is_free(scene, gap.after)) return {};
  const Thing &fluid = is_before ? gap.before : gap.after, &other = is_before ? gap.after : gap.before;
  const Bounds box = bounds_within(fluid.body->shape, {scene.grid.lower, scene.grid.upper});
  if (gap.size() <= least_gap(scene) || gap.size() > most_share * (box.upper[axis] - box.lower[axis])) return {};
  return fluid.name() + " ends " + metres(gap.size()) + " before " + other.name() + " along " +
         std::string(1, "xyz"[axis]) + " (" + place_in_words(gap, axis) + "): it will flow there";
}

/// The first gap that there is something to say of.
template <class InWords>
std::string first_gap(const Scene& scene, const Places& places, std::size_t axis, const InWords& in_words) {
  for (const Line& line : lines_along(scene, places, axis))
    for (const Gap& gap : line.gaps())
      if (std::string words = in_words(scene, gap, axis); !words.empty()) return words;
  return {};
}

}  // namespace

std::vector<std::string> doubtful_gaps(const Scene& scene) {
  if (strength_of_gravity(scene) <= 0) return {};
  const Places places(scene);
  const std::size_t vertical = scene.grid.lower.size() - 1;
  std::vector<std::string> found{first_gap(scene, places, vertical, fall_in_words)};
  for (std::size_t axis = 0; axis < vertical; ++axis) found.push_back(first_gap(scene, places, axis, flow_in_words));
  std::erase(found, "");
  return found;
}

}  // namespace geodrop
