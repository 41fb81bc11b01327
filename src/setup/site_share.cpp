#include "site_share.hpp"

#include <geodrop/geometry/triangle_surface.hpp>

#include <algorithm>
#include <cmath>

#include "geometry/corner.hpp"

namespace geodrop {
namespace {

bool apart(const Bounds& a, const Bounds& b) {
  for (std::size_t axis = 0; axis < a.lower.size(); ++axis)
    if (a.upper[axis] <= b.lower[axis] || a.lower[axis] >= b.upper[axis]) return true;
  return false;
}

/// How many of the site's corners lie inside; `of` is how many there are.
struct CornerCount {
  unsigned inside, of;
};

CornerCount count_corners(const Shape& shape, const Bounds& site) {
  const std::size_t dimension = site.lower.size();
  CornerCount count{0, 1u << dimension};
  Point corner(dimension);
  for (unsigned k = 0; k < count.of; ++k) {
    for (std::size_t a = 0; a < dimension; ++a) corner[a] = (k >> a & 1u) != 0 ? site.upper[a] : site.lower[a];
    if (contains(shape, corner)) ++count.inside;
  }
  return count;
}

/// Whether an ellipse's nearest point of the site is outside; in its own axes that is the centre clamped to the site.
bool is_beyond(const EllipseShape& ellipse, const Bounds& site) {
  if (ellipse.tilt_deg != 0) return false;  // not known without more work
  Point nearest = ellipse.centre;
  for (std::size_t a = 0; a < nearest.size(); ++a) nearest[a] = std::clamp(nearest[a], site.lower[a], site.upper[a]);
  return !contains(ellipse, nearest);
}

/// A surface that does not cut a site leaves it inside or outside as a whole.
Cover cover_by(const InsideShape& inside, const Bounds& site) {
  const SurfaceRegion& region = *inside.region;
  if (region.may_cut(to_corner(site.lower), to_corner(site.upper))) return Cover::part;
  Corner middle;
  for (std::size_t a = 0; a < 3; ++a) middle[a] = (site.lower[a] + site.upper[a]) / 2;
  return region.contains(middle) ? Cover::all : Cover::none;
}

/// Exact.
SiteShare<3> share_inside(const InsideShape& inside, const Bounds& site) {
  const auto [volume, first] = inside.region->moments_in(to_corner(site.lower), to_corner(site.upper));
  double whole = 1;
  for (std::size_t a = 0; a < 3; ++a) whole *= site.upper[a] - site.lower[a];
  SiteShare<3> part{volume / whole, {}};
  if (volume > 0)
    for (std::size_t a = 0; a < 3; ++a) part.centroid[a] = std::clamp(first[a] / volume, site.lower[a], site.upper[a]);
  return part;
}

/// Cheap, for the many sites that no outline crosses.
Cover cover_by(const Outlined& outlined, const Bounds& site) {
  const Shape& shape = *outlined.shape;
  if (apart(site, outlined.box)) return Cover::none;
  if (const auto* inside = std::get_if<InsideShape>(&shape)) return cover_by(*inside, site);
  if (!std::holds_alternative<PolygonShape>(shape)) {
    // All other shapes are convex, so their corners decide; what is outside of a half-plane is convex as well.
    const CornerCount corners = count_corners(shape, site);
    if (corners.inside == corners.of) return Cover::all;
    if (corners.inside > 0) return Cover::part;
    const auto* ellipse = std::get_if<EllipseShape>(&shape);
    const bool outside = std::holds_alternative<HalfPlaneShape>(shape) || (ellipse && is_beyond(*ellipse, site));
    return outside ? Cover::none : Cover::part;
  }
  const Point centre{(site.lower[0] + site.upper[0]) / 2, (site.lower[1] + site.upper[1]) / 2};
  const double radius = std::hypot(site.upper[0] - centre[0], site.upper[1] - centre[1]);
  const PolygonInBox polygon(outlined.edges, site);
  if (polygon.comes_near(centre, radius)) return Cover::part;
  return polygon.contains(centre) ? Cover::all : Cover::none;
}

struct GaussPoint {
  double x, weight;
};

/// Gauss points in each interval between the levels, which need no order and may lie outside the site. The map
/// x(t) = t^2 (3 - 2 t) from Gauss's interval crowds them at both ends, where the length of a row grows like a square
/// root if an outline begins there; six of them make that exact to about 1e-7 and cubic polynomials exact.
std::vector<GaussPoint> gauss_points(std::vector<double> levels, double low, double high) {
  constexpr int pieces = 2;  // for kinks at levels that nobody lists, as where two outlines cross
  constexpr std::array<GaussPoint, 3> half_rule{{{0.2386191860831969, 0.4679139345726910},
                                                 {0.6612093864662645, 0.3607615730481386},
                                                 {0.9324695142031521, 0.1713244923791704}}};
  for (int k = 0; k <= pieces; ++k) levels.push_back(low + (high - low) * k / pieces);
  for (double& level : levels) level = std::clamp(level, low, high);
  std::sort(levels.begin(), levels.end());
  std::vector<GaussPoint> points;
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const double from = levels[k - 1], width = levels[k] - from;
    if (width <= 0) continue;
    for (const GaussPoint& g : half_rule) {
      for (const double t : {(1 - g.x) / 2, (1 + g.x) / 2})
        points.push_back({from + width * t * t * (3 - 2 * t), width * g.weight * 3 * t * (1 - t)});
    }
  }
  return points;
}

/// An outline within a site.
class Cutter {
 public:
  Cutter(const Outlined& outlined, const Bounds& site) : outlined_(&outlined), site_(&site) {
    if (std::holds_alternative<PolygonShape>(shape())) polygon_.emplace(outlined.edges, site);
  }

  const Shape& shape() const { return *outlined_->shape; }
  const Bounds& box() const { return outlined_->box; }
  /// What the row at height y has in common with the shape.
  std::vector<Chord> row(double y) const {
    return polygon_ ? polygon_->row(y) : chords(shape(), {site_->lower[0], y}, 0);
  }
  /// Heights at which the length of a row may have a kink.
  void add_levels(std::vector<double>& levels) const {
    levels.insert(levels.end(), {box().lower[1], box().upper[1]});
    if (polygon_) return polygon_->add_levels(levels);
    for (const Point& side : {site_->lower, site_->upper})
      for (const Chord& chord : chords(shape(), side, 1)) levels.insert(levels.end(), {chord.from, chord.to});
  }

 private:
  const Outlined* outlined_;
  const Bounds* site_;
  std::optional<PolygonInBox> polygon_;
};

/// A site that outlines cut: a shape (none: all of the site) less some others.
struct CutSite {
  CutSite(const Bounds& site_, const Outlined* whole, const std::vector<const Outlined*>& removed) : site(site_) {
    if (whole) shape.emplace(*whole, site);
    for (const Outlined* hole : removed) holes.emplace_back(*hole, site);
  }

  const Bounds& site;
  std::optional<Cutter> shape;
  std::vector<Cutter> holes;

  template <class Visit>
  void for_each_shape(Visit visit) const {
    if (shape) visit(*shape);
    for (const Cutter& hole : holes) visit(hole);
  }
};

std::vector<double> levels_of_rows(const CutSite& cut) {
  std::vector<double> levels;
  cut.for_each_shape([&](const Cutter& cutter) { cutter.add_levels(levels); });
  return levels;
}

/// Heights z at which the area of a section may have a kink: where an outline begins or ends, in the site or on one of
/// its upright faces, and where it crosses an upright edge.
std::vector<double> levels_of_sections(const CutSite& cut) {
  std::vector<double> levels;
  const Bounds& site = cut.site;
  cut.for_each_shape([&](const Cutter& cutter) {
    const Shape& shape = cutter.shape();
    levels.insert(levels.end(), {cutter.box().lower[2], cutter.box().upper[2]});
    for (const double x : {site.lower[0], site.upper[0]})
      for (const double y : {site.lower[1], site.upper[1]})
        for (const Chord& chord : chords(shape, {x, y, 0}, 2)) levels.insert(levels.end(), {chord.from, chord.to});
    for (const int axis : {0, 1})
      for (const double face : {site.lower[axis], site.upper[axis]})
        if (const std::optional<Shape> on_face = section(shape, axis, face)) {
          const Bounds reach = bounds(*on_face);
          levels.insert(levels.end(), {reach.lower[1], reach.upper[1]});
        }
  });
  return levels;
}

/// What the row at height y has of the region within the site.
std::vector<Chord> pieces_of_row(const CutSite& cut, double y) {
  const Chord whole{cut.site.lower[0], cut.site.upper[0]};
  std::vector<Chord> row;
  const auto keep = [](std::vector<Chord>& list, double from, double to) {
    if (to > from) list.push_back({from, to});
  };
  if (!cut.shape) row.push_back(whole);
  if (cut.shape)
    for (const Chord& c : cut.shape->row(y)) keep(row, std::max(c.from, whole.from), std::min(c.to, whole.to));
  for (const Cutter& hole : cut.holes)
    for (const Chord& c : hole.row(y)) {
      std::vector<Chord> left;
      for (const Chord& piece : row) {
        keep(left, piece.from, std::min(piece.to, c.from));
        keep(left, std::max(piece.from, c.to), piece.to);
      }
      row = std::move(left);
    }
  return row;
}

SiteShare<2> integrate(const CutSite& cut) {
  SiteShare<2> sum;
  const Bounds& site = cut.site;
  for (const GaussPoint& y : gauss_points(levels_of_rows(cut), site.lower[1], site.upper[1]))
    for (const Chord& piece : pieces_of_row(cut, y.x)) {
      const double part = y.weight * (piece.to - piece.from);
      sum.share += part;
      sum.centroid[0] += part * (piece.from + piece.to) / 2;
      sum.centroid[1] += part * y.x;
    }
  if (sum.share > 0)
    for (double& c : sum.centroid) c /= sum.share;
  sum.share /= (site.upper[0] - site.lower[0]) * (site.upper[1] - site.lower[1]);
  return sum;
}

/// The share of the site's section at height z.
SiteShare<2> integrate_section(const CutSite& cut, double z) {
  const Bounds face{{cut.site.lower[0], cut.site.lower[1]}, {cut.site.upper[0], cut.site.upper[1]}};
  std::vector<Shape> sections;
  const auto cuts = [&](const Cutter& cutter) {
    const std::optional<Shape> through = section(cutter.shape(), 2, z);
    if (through) sections.push_back(*through);
    return through.has_value();
  };
  if (cut.shape && !cuts(*cut.shape)) return {};
  for (const Cutter& hole : cut.holes) cuts(hole);
  const std::vector<Outlined> outlined(sections.begin(), sections.end());
  std::vector<const Outlined*> holes;
  for (const Outlined& each : outlined) holes.push_back(&each);
  const Outlined* shape = cut.shape ? holes.front() : nullptr;
  if (shape) holes.erase(holes.begin());
  return integrate({face, shape, holes});
}

SiteShare<3> integrate_in_space(const CutSite& cut) {
  SiteShare<3> sum;
  const double low = cut.site.lower[2], high = cut.site.upper[2];
  for (const GaussPoint& z : gauss_points(levels_of_sections(cut), low, high)) {
    const SiteShare<2> slice = integrate_section(cut, z.x);
    const double part = z.weight * slice.share;
    sum.share += part;
    for (int a = 0; a < 2; ++a) sum.centroid[a] += part * slice.centroid[a];
    sum.centroid[2] += part * z.x;
  }
  if (sum.share > 0)
    for (double& c : sum.centroid) c /= sum.share;
  sum.share /= high - low;
  return sum;
}

/// Exact where a surface and no other outline cuts the site.
SiteShare<3> without_surfaces(const Bounds& site, const Outlined* whole, const std::vector<const Outlined*>& removed) {
  const auto surface_of = [](const Outlined* of) { return of ? std::get_if<InsideShape>(of->shape) : nullptr; };
  std::vector<const Outlined*> others;
  for (const Outlined* hole : removed)
    if (!surface_of(hole)) others.push_back(hole);
  const InsideShape* inside = surface_of(whole);
  SiteShare<3> sum = inside ? share_inside(*inside, site) : integrate_in_space({site, whole, others});
  for (const Outlined* hole : removed) {
    if (!surface_of(hole)) continue;
    const SiteShare<3> gone = share_inside(*surface_of(hole), site);
    const double left = sum.share - gone.share;
    if (!(left > 0)) return {};
    for (std::size_t a = 0; a < 3; ++a)
      sum.centroid[a] = std::clamp((sum.share * sum.centroid[a] - gone.share * gone.centroid[a]) / left, site.lower[a],
                                   site.upper[a]);
    sum.share = left;
  }
  return sum;
}

}  // namespace

Outlined::Outlined(const Shape& shape_) : shape(&shape_), box(bounds(shape_)) {
  if (const auto* polygon = std::get_if<PolygonShape>(shape)) edges = edges_of(*polygon);
}

BodyRegion::BodyRegion(const Scene& scene, const BodySpec& spec) : shape_(spec.shape) {
  for (const std::string& name : spec.minus)
    if (const BodySpec* other = find_body(scene, name)) removed_.emplace_back(other->shape);
}

bool BodyRegion::holds(const Point& x) const {
  return contains(*shape_.shape, x) &&
         std::none_of(removed_.begin(), removed_.end(), [&](const Outlined& r) { return contains(*r.shape, x); });
}

Cover BodyRegion::cover(const Bounds& box) const {
  Cover region = cover_by(shape_, box);
  for (const Outlined& removed : removed_) {
    const Cover hole = cover_by(removed, box);
    if (hole == Cover::all) return Cover::none;
    if (hole == Cover::part && region == Cover::all) region = Cover::part;
  }
  return region;
}

template <int Dim>
SiteShare<Dim> BodyRegion::share(const Bounds& site) const {
  constexpr double rounding = 1e-9;  // an outline on a site's edge leaves the site whole
  const Cover inside = cover_by(shape_, site);
  if (inside == Cover::none) return {};
  std::vector<const Outlined*> holes;
  for (const Outlined& removed : removed_) {
    const Cover hole = cover_by(removed, site);
    if (hole == Cover::all) return {};
    if (hole == Cover::part) holes.push_back(&removed);
  }
  if (inside == Cover::all && holes.empty()) return whole_site<Dim>(site);
  const Outlined* whole = inside == Cover::all ? nullptr : &shape_;
  SiteShare<Dim> cut;
  if constexpr (Dim == 2) cut = integrate({site, whole, holes});
  if constexpr (Dim == 3) cut = without_surfaces(site, whole, holes);
  if (cut.share < rounding) return {};
  return cut.share > 1 - rounding ? whole_site<Dim>(site) : cut;
}

template SiteShare<2> BodyRegion::share<2>(const Bounds&) const;
template SiteShare<3> BodyRegion::share<3>(const Bounds&) const;

}  // namespace geodrop
