#include "site_share.hpp"

#include <algorithm>
#include <cmath>

namespace geodrop {
namespace {

/// What a shape does to a site.
enum class Cover { none, part, all };

bool apart(const Bounds& a, const Bounds& b) {
  for (std::size_t axis = 0; axis < a.lower.size(); ++axis)
    if (a.upper[axis] <= b.lower[axis] || a.lower[axis] >= b.upper[axis]) return true;
  return false;
}

bool holds_corners(const Shape& shape, const Bounds& site) {
  const std::size_t dimension = site.lower.size();
  Point corner(dimension);
  for (unsigned k = 0; k < 1u << dimension; ++k) {
    for (std::size_t a = 0; a < dimension; ++a) corner[a] = (k >> a & 1u) != 0 ? site.upper[a] : site.lower[a];
    if (!contains(shape, corner)) return false;
  }
  return true;
}

/// Cheap, for the many sites that no outline crosses; `part` may also be said of a site that is just touched.
Cover cover(const Shape& shape, const Bounds& site) {
  if (apart(site, bounds(shape))) return Cover::none;
  // All other shapes are convex, so their corners decide.
  if (!std::holds_alternative<PolygonShape>(shape)) return holds_corners(shape, site) ? Cover::all : Cover::part;
  const Point centre{(site.lower[0] + site.upper[0]) / 2, (site.lower[1] + site.upper[1]) / 2};
  const double radius = std::hypot(site.upper[0] - centre[0], site.upper[1] - centre[1]);
  if (distance_to_outline(shape, centre) <= radius) return Cover::part;
  return contains(shape, centre) ? Cover::all : Cover::none;
}

struct GaussPoint {
  double x, weight;
};

/// Three Gauss points in each interval between the levels, which need no order and may lie outside the site.
std::vector<GaussPoint> gauss_points(std::vector<double> levels, double low, double high) {
  constexpr int pieces = 4;  // for curved outlines
  for (int k = 0; k <= pieces; ++k) levels.push_back(low + (high - low) * k / pieces);
  for (double& level : levels) level = std::clamp(level, low, high);
  std::sort(levels.begin(), levels.end());
  std::vector<GaussPoint> points;
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const double half = (levels[k] - levels[k - 1]) / 2, middle = levels[k - 1] + half;
    if (half <= 0) continue;
    const double reach = half * std::sqrt(0.6);
    points.push_back({middle - reach, half * 5 / 9});
    points.push_back({middle, half * 8 / 9});
    points.push_back({middle + reach, half * 5 / 9});
  }
  return points;
}

/// One site that outlines cut: a shape (none: all of the site) less some others.
template <int Dim>
class CutSite {
 public:
  CutSite(const Bounds& site, const Shape* shape, const std::vector<const Shape*>& holes)
      : site_(site), shape_(shape), holes_(holes) {}

  SiteShare<Dim> integrate() const {
    SiteShare<Dim> sum;
    std::array<std::vector<GaussPoint>, Dim> points;
    points[0] = {{site_.lower[0], 1}};  // rows run along x
    double volume = site_.upper[0] - site_.lower[0];
    std::size_t rows = 1;
    for (int a = 1; a < Dim; ++a) {
      points[a] = gauss_points(levels(a), site_.lower[a], site_.upper[a]);
      volume *= site_.upper[a] - site_.lower[a];
      rows *= points[a].size();
    }
    Point x(Dim);
    for (std::size_t row = 0; row < rows; ++row) {
      double weight = 1;
      std::size_t rest = row;
      for (int a = 0; a < Dim; rest /= points[a].size(), ++a) {
        const GaussPoint& point = points[a][rest % points[a].size()];
        x[a] = point.x;
        weight *= point.weight;
      }
      for (const Chord& piece : pieces(x)) {
        const double part = weight * (piece.to - piece.from);
        sum.share += part;
        sum.centroid[0] += part * (piece.from + piece.to) / 2;
        for (int a = 1; a < Dim; ++a) sum.centroid[a] += part * x[a];
      }
    }
    if (sum.share > 0)
      for (double& c : sum.centroid) c /= sum.share;
    sum.share /= volume;
    return sum;
  }

 private:
  /// Where the length of a row may have a kink.
  std::vector<double> levels(int axis) const {
    std::vector<double> found;
    if (shape_) add_levels(*shape_, axis, found);
    for (const Shape* hole : holes_) add_levels(*hole, axis, found);
    return found;
  }

  void add_levels(const Shape& shape, int axis, std::vector<double>& found) const {
    const auto add = [&](double level) {
      if (level > site_.lower[axis] && level < site_.upper[axis]) found.push_back(level);
    };
    const Bounds box = bounds(shape);
    add(box.lower[axis]);
    add(box.upper[axis]);
    if constexpr (Dim != 2) return;
    if (const auto* polygon = std::get_if<PolygonShape>(&shape))
      for (const Point& corner : polygon->points) add(corner[axis]);
    for (const Point& side : {site_.lower, site_.upper})
      for (const Chord& chord : chords(shape, side, axis)) {
        add(chord.from);
        add(chord.to);
      }
  }

  /// What the row through x has of the region within the site.
  std::vector<Chord> pieces(const Point& x) const {
    const Chord whole{site_.lower[0], site_.upper[0]};
    std::vector<Chord> row;
    const auto keep = [](std::vector<Chord>& list, double from, double to) {
      if (to > from) list.push_back({from, to});
    };
    if (!shape_) row.push_back(whole);
    if (shape_)
      for (const Chord& c : chords(*shape_, x, 0)) keep(row, std::max(c.from, whole.from), std::min(c.to, whole.to));
    for (const Shape* hole : holes_)
      for (const Chord& c : chords(*hole, x, 0)) {
        std::vector<Chord> left;
        for (const Chord& piece : row) {
          keep(left, piece.from, std::min(piece.to, c.from));
          keep(left, std::max(piece.from, c.to), piece.to);
        }
        row = std::move(left);
      }
    return row;
  }

  const Bounds& site_;
  const Shape* shape_;
  const std::vector<const Shape*>& holes_;
};

}  // namespace

BodyRegion::BodyRegion(const Scene& scene, const BodySpec& spec) : shape_(&spec.shape) {
  for (const std::string& name : spec.minus)
    for (const BodySpec& other : scene.bodies)
      if (other.name == name) removed_.push_back(&other.shape);
}

bool BodyRegion::holds(const Point& x) const {
  return contains(*shape_, x) &&
         std::none_of(removed_.begin(), removed_.end(), [&](const Shape* s) { return contains(*s, x); });
}

template <int Dim>
SiteShare<Dim> BodyRegion::share(const Bounds& site) const {
  constexpr double rounding = 1e-9;  // an outline on a site's edge leaves the site whole
  SiteShare<Dim> whole{1, {}};
  for (int a = 0; a < Dim; ++a) whole.centroid[a] = (site.lower[a] + site.upper[a]) / 2;
  const Cover inside = cover(*shape_, site);
  if (inside == Cover::none) return {};
  std::vector<const Shape*> holes;
  for (const Shape* removed : removed_) {
    const Cover hole = cover(*removed, site);
    if (hole == Cover::all) return {};
    if (hole == Cover::part) holes.push_back(removed);
  }
  if (inside == Cover::all && holes.empty()) return whole;
  const SiteShare<Dim> cut = CutSite<Dim>(site, inside == Cover::all ? nullptr : shape_, holes).integrate();
  if (cut.share < rounding) return {};
  return cut.share > 1 - rounding ? whole : cut;
}

template SiteShare<2> BodyRegion::share<2>(const Bounds&) const;
template SiteShare<3> BodyRegion::share<3>(const Bounds&) const;

}  // namespace geodrop
