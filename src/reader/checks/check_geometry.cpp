// Checks of where bodies are: sound shapes, inside the domain, not empty, no two on the same place.
#include "check_scene.hpp"

#include "setup/fill_particles.hpp"

#include <geodrop/geometry/shapes.hpp>
#include <geodrop/grid/graded_axis.hpp>

#include <algorithm>
#include <cmath>

namespace geodrop {
namespace {

double cross(const Point& o, const Point& a, const Point& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

bool segments_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  return cross(a, b, c) * cross(a, b, d) < 0 && cross(c, d, a) * cross(c, d, b) < 0;
}

void check_shape(const BodySpec& body, const std::string& key, Report& report) {
  if (!report.healthy(key)) return;
  if (const auto* box = std::get_if<BoxShape>(&body.shape)) check_box(*box, key, report);
  if (const auto* polygon = std::get_if<PolygonShape>(&body.shape)) check_polygon(*polygon, key, report);
  const auto* half = std::get_if<HalfPlaneShape>(&body.shape);
  if (half && !shape_is_sound(body.shape))
    report.add(key + ".normal", to_text(half->normal), "a vector that is not zero");
}

Bounds common(const Bounds& a, const Bounds& b) {
  Bounds box = a;
  for (std::size_t axis = 0; axis < box.lower.size(); ++axis) {
    box.lower[axis] = std::max(a.lower[axis], b.lower[axis]);
    box.upper[axis] = std::min(a.upper[axis], b.upper[axis]);
  }
  return box;
}

/// An even lattice of points in a box. Its offset keeps points off edges at simple fractions.
class Samples {
 public:
  Samples(const Bounds& box, double spacing) : box_(box), count_(box.lower.size()) {
    const bool plane = box.lower.size() == 2;
    const double per_cell = plane ? 16 : 8, most = plane ? 600 : 100;  // along each axis
    for (std::size_t a = 0; a < count_.size(); ++a)
      count_[a] = static_cast<int>(std::clamp(std::ceil(width(a) / spacing * per_cell), 1.0, most));
  }

  /// Area or volume per point [m2, m3].
  double measure() const {
    double product = 1;
    for (std::size_t a = 0; a < count_.size(); ++a) product *= width(a) / count_[a];
    return product;
  }

  /// Until `visit` gives false.
  template <class Visit>
  void for_each(Visit visit) const {
    constexpr double offset[] = {0.381966, 0.618034, 0.549150};
    long long points = 1;
    for (const int n : count_) points *= n;
    Point x(count_.size());
    for (long long k = 0; k < points; ++k) {
      long long rest = k;
      for (std::size_t a = 0; a < count_.size(); rest /= count_[a], ++a)
        x[a] = box_.lower[a] + (static_cast<double>(rest % count_[a]) + offset[a]) * width(a) / count_[a];
      if (!visit(x)) return;
    }
  }

 private:
  double width(std::size_t axis) const { return box_.upper[axis] - box_.lower[axis]; }

  Bounds box_;
  std::vector<int> count_;
};

bool is_empty(const Bounds& box, double spacing) {
  constexpr double kRounding = 1e-6;  // of a cell
  for (std::size_t a = 0; a < box.lower.size(); ++a)
    if (box.upper[a] - box.lower[a] < kRounding * spacing) return true;
  return false;
}

class PlacementCheck {
 public:
  PlacementCheck(const Scene& scene, Report& report)
      : scene_(scene), report_(report), domain_{scene.grid.lower, scene.grid.upper}, h_(finest_spacing(scene.grid)) {}

  void run() {
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      if (!is_ready(i)) continue;
      if (!check_inside(i) || !check_not_empty(i) || !check_particles(i)) continue;
      for (std::size_t j = 0; j < i; ++j) {
        // One that is cut out of the other shares no point with it, however finely one looks.
        if (is_ready(j) && !cuts(i, j) && !cuts(j, i) && arrival(i) == arrival(j) && !fills_pores(i, j) &&
            !fills_pores(j, i))
          check_overlap(i, j);
      }
    }
  }

 private:
  const BodySpec& body(std::size_t i) const { return scene_.bodies[i]; }
  std::string key(std::size_t i) const { return report_.element("bodies", i); }

  bool is_ready(std::size_t i) const {
    const bool drawn = !std::holds_alternative<InsideShape>(body(i).shape) || shape_is_sound(body(i).shape);
    return drawn && report_.healthy(key(i) + ".shape") && report_.healthy(key(i) + ".minus") && cuts_are_known(i);
  }

  /// No body in its minus has a shape with a mistake, which would not cut anything.
  bool cuts_are_known(std::size_t i) const {
    for (std::size_t j = 0; j < scene_.bodies.size(); ++j)
      if (cuts(i, j) && !report_.healthy(key(j) + ".shape")) return false;
    return true;
  }

  /// When body i comes in [s]: what is at its place before may be gone by then, see refuse_full_cells.
  double arrival(std::size_t i) const {
    const auto stage = std::ranges::find_if(scene_.stages, [&](const StageSpec& one) {
      return std::ranges::find(one.places, body(i).name) != one.places.end();
    });
    return stage == scene_.stages.end() ? 0 : stage->from;
  }

  /// Body i has body j in its minus.
  bool cuts(std::size_t i, std::size_t j) const {
    return std::any_of(body(i).minus.begin(), body(i).minus.end(),
                       [&](const std::string& name) { return find_body(scene_, name) == &body(j); });
  }

  /// Body i is the water in the pores of body j.
  bool fills_pores(std::size_t i, std::size_t j) const { return body(j).saturated_by == body(i).name; }

  /// The part of a body that is looked at: its box within the domain.
  Bounds inside(std::size_t i) const { return common(bounds_within(body(i).shape, domain_), domain_); }

  bool covers(std::size_t i, const Point& x) const {
    if (!contains(body(i).shape, x)) return false;
    return std::none_of(body(i).minus.begin(), body(i).minus.end(), [&](const std::string& name) {
      const BodySpec* cut = find_body(scene_, name);
      return cut && shape_is_sound(cut->shape) && contains(cut->shape, x);
    });
  }

  bool check_inside(std::size_t i) {
    if (std::holds_alternative<HalfPlaneShape>(body(i).shape)) return true;  // is cut off by the domain
    constexpr double kRounding = 1e-6;                                       // of a cell
    const Bounds box = bounds(body(i).shape);
    for (std::size_t a = 0; a < box.lower.size(); ++a) {
      if (box.lower[a] >= domain_.lower[a] - kRounding * h_ && box.upper[a] <= domain_.upper[a] + kRounding * h_)
        continue;
      report_.add(key(i) + ".shape", "a body from " + to_text(box.lower) + " to " + to_text(box.upper),
                  "a body inside the grid, from " + to_text(domain_.lower) + " to " + to_text(domain_.upper) + " [m]");
      return false;
    }
    return true;
  }

  bool check_not_empty(std::size_t i) {
    const Bounds box = inside(i);
    bool found = false;
    if (!is_empty(box, h_)) {
      Samples(box, h_).for_each([&](const Point& x) {
        found = covers(i, x);
        return !found;
      });
    }
    if (!found)
      report_.add(key(i) + ".shape", "a body of which nothing is left",
                  std::string("a shape that has ") + (scene_.dimension == 2 ? "area" : "volume") +
                      " inside the grid and outside the bodies in minus");
    return found;
  }

  bool check_particles(std::size_t i) {
    const auto& cuts = body(i).minus;
    const bool ready = report_.healthy(key(i)) && std::all_of(cuts.begin(), cuts.end(), [&](const std::string& name) {
                         const BodySpec* cut = find_body(scene_, name);
                         return cut && shape_is_sound(cut->shape);
                       });
    if (!ready || has_particles(scene_, body(i))) return true;
    report_.add(key(i) + ".shape", "a shape without particles",
                "a shape that fills 2 % of a particle's site somewhere; sites are " +
                    to_text(h_ / body(i).particles_per_cell_axis) + " m wide");
    return false;
  }

  void check_overlap(std::size_t i, std::size_t j) {
    constexpr double kAllowed = 0.01;  // of a cell: below any particle
    constexpr int kMostOverlaps = 20;  // each may take a second; who has more has one mistake, not many
    if (overlaps_ == kMostOverlaps) return;
    const Bounds box = common(inside(i), inside(j));
    if (is_empty(box, h_)) return;
    int hits = 0;
    Point where;
    const Samples samples(box, h_);
    samples.for_each([&](const Point& x) {
      if (covers(i, x) && covers(j, x) && hits++ == 0) where = x;
      return true;
    });
    const double common_part = hits * samples.measure();
    if (common_part <= kAllowed * std::pow(h_, scene_.dimension)) return;
    for (double& coordinate : where) coordinate = round_to_3(coordinate);
    const bool last = ++overlaps_ == kMostOverlaps;
    report_.add(key(i) + ".shape",
                "a body that overlaps \"" + body(j).name + "\" by about " + to_text(round_to_3(common_part)) +
                    (scene_.dimension == 2 ? " m2" : " m3") + ", e.g. at " + to_text(where),
                "bodies that do not overlap; minus = [\"" + body(j).name + "\"] cuts one out of the other" +
                    (last ? " (others are not looked at after " + std::to_string(kMostOverlaps) + ")" : ""));
  }

  /// Three digits are enough for a message.
  static double round_to_3(double value) {
    if (value == 0) return 0;
    const double digits = 2 - std::floor(std::log10(std::abs(value)));
    return std::round(value * std::pow(10, digits)) / std::pow(10, digits);
  }

  const Scene& scene_;
  Report& report_;
  int overlaps_ = 0;
  Bounds domain_;
  double h_;
};

}  // namespace

double distance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t axis = 0; axis < a.size(); ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return std::sqrt(sum);
}

bool crosses_itself(const std::vector<Point>& points, Ends ends) {
  const std::size_t n = points.size(), legs = ends == Ends::closed ? n : n - 1;
  for (std::size_t i = 0; i < legs; ++i) {
    for (std::size_t j = i + 2; j < legs; ++j) {
      if (segments_cross(points[i], points[i + 1], points[j], points[(j + 1) % n])) return true;
    }
  }
  return false;
}

void check_box(const BoxShape& box, const std::string& key, Report& report) {
  for (std::size_t a = 0; a < box.lower.size(); ++a) {
    if (box.upper[a] > box.lower[a]) continue;
    report.add(key + ".upper", to_text(box.upper), "larger than lower " + to_text(box.lower) + " along each axis");
    return;
  }
}

void check_polygon(const PolygonShape& polygon, const std::string& key, Report& report) {
  if (polygon.points.size() < 3) {
    report.add(key + ".points", std::to_string(polygon.points.size()) + " points", "at least 3 points");
  } else if (crosses_itself(polygon.points, Ends::closed)) {
    report.add(key + ".points", "an outline that crosses itself", "a polygon that does not cross itself");
  } else if (area(polygon) <= 0) {
    report.add(key + ".points", "a polygon without area", "points that are not all on one line");
  } else {
    check_legs(polygon.points, Ends::closed, key + ".points", report);
  }
}

void check_legs(const std::vector<Point>& points, Ends ends, const std::string& key, Report& report) {
  constexpr double kRounding = 1e-9;  // of the outline's extent
  const std::size_t n = points.size();
  if (n < 2) return;
  const Bounds box = bounds(PolygonShape{points});
  const double least = kRounding * distance(box.lower, box.upper);
  for (std::size_t i = 1; i < n; ++i) {
    if (distance(points[i - 1], points[i]) <= least)
      report.add(key + '.' + std::to_string(i), "the point " + to_text(points[i]) + " twice in a row",
                 "points that differ from the one before");
  }
  if (ends == Ends::closed && n > 2 && distance(points.back(), points.front()) <= least)
    report.add(key + '.' + std::to_string(n - 1), "the first point " + to_text(points.front()) + " again at the end",
               "each point once: the last point joins the first by itself");
}

bool shape_is_sound(const Shape& shape) {
  if (const auto* polygon = std::get_if<PolygonShape>(&shape)) return polygon->points.size() >= 3;
  if (const auto* ellipse = std::get_if<EllipseShape>(&shape))
    return ellipse->centre.size() >= 2 && ellipse->semi_axes.size() == ellipse->centre.size();
  if (const auto* stadium = std::get_if<StadiumShape>(&shape))
    return stadium->centre.size() == 2 && stadium->semi_axes.size() == 2;
  if (const auto* box = std::get_if<BoxShape>(&shape))
    return box->lower.size() >= 2 && box->upper.size() == box->lower.size();
  if (const auto* inside = std::get_if<InsideShape>(&shape)) return inside->region != nullptr;
  const auto& half = std::get<HalfPlaneShape>(shape);
  const bool has_normal = std::any_of(half.normal.begin(), half.normal.end(), [](double n) { return n != 0; });
  return half.point.size() >= 2 && half.normal.size() == half.point.size() && has_normal;
}

void check_geometry(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    check_shape(scene.bodies[i], report.element("bodies", i) + ".shape", report);
    const auto* inside = std::get_if<InsideShape>(&scene.bodies[i].shape);
    if (inside && report.healthy(report.element("bodies", i) + ".shape"))
      check_reference(report.element("bodies", i) + ".shape.membrane", inside->membrane, names_of(scene.membranes),
                      "membranes", report);
  }
  // A domain or a dimension that is wrong would make every body wrong.
  if (report.healthy("grid") && report.healthy("dimension")) PlacementCheck(scene, report).run();
}

}  // namespace geodrop
