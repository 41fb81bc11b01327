// Checks of rigid bodies and of what touches them.
#include "check_scene.hpp"

#include "contact/rigid_surface.hpp"
#include "contact/space_surface.hpp"
#include "scene/needs.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/geometry/triangle_surface.hpp>
#include <geodrop/grid/graded_axis.hpp>

#include <algorithm>
#include <set>

namespace geodrop {
namespace {

void check_table(const TableMotionSpec& table, const std::string& key, Report& report) {
  const bool rotation = table.displacements.empty();
  const std::string listed = rotation ? ".angles_deg" : ".displacements";
  const std::size_t values = rotation ? table.angles_deg.size() : table.displacements.size();
  const bool ascending = std::is_sorted(table.times.begin(), table.times.end(), std::less_equal<>());
  if (table.times.size() < 2 || !ascending)
    report.add(key + ".times", to_text(table.times), "at least two times, each after the one before");
  else if (values != table.times.size())
    report.add(key + listed, std::to_string(values) + " values for " + std::to_string(table.times.size()) + " times",
               "one value for each time");
}

void check_prism(const PrismShape& prism, const std::string& key, Report& report) {
  const auto elsewhere = std::find_if(prism.points.begin(), prism.points.end(),
                                      [&](const Point& point) { return point[0] != prism.points.front()[0]; });
  if (elsewhere != prism.points.end())
    report.add(key + ".points", to_text(*elsewhere) + " after " + to_text(prism.points.front()),
               "corners that have the same x");
  else
    check_polygon(section_of(prism), key, report);
}

void check_rigid_shape(const RigidShape& shape, const std::string& key, Report& report) {
  if (const auto* box = std::get_if<BoxShape>(&shape)) check_box(*box, key, report);
  if (const auto* polygon = std::get_if<PolygonShape>(&shape)) check_polygon(*polygon, key, report);
  if (const auto* prism = std::get_if<PrismShape>(&shape)) check_prism(*prism, key, report);
  const auto* line = std::get_if<PolylineShape>(&shape);
  if (!line) return;
  if (line->points.size() < 2)
    report.add(key + ".points", std::to_string(line->points.size()) + " points", "at least 2 points");
  else if (crosses_itself(line->points, Ends::open))
    report.add(key + ".points", "a line that crosses itself", "a polyline that does not cross itself");
  else
    check_legs(line->points, Ends::open, key + ".points", report);
}

bool turns(const RigidMotion& motion) {
  const auto* table = std::get_if<TableMotionSpec>(&motion);
  return std::holds_alternative<HingeMotionSpec>(motion) || (table && !table->angles_deg.empty());
}

void check_rigid(const Scene& scene, const RigidSpec& rigid, const std::string& key, Report& report) {
  const auto* half = std::get_if<HalfPlaneShape>(&rigid.shape);
  if (half && report.healthy(key + ".shape") && !shape_is_sound(*half))
    report.add(key + ".shape.normal", to_text(half->normal), "a vector that is not zero");
  if (report.healthy(key + ".shape")) check_rigid_shape(rigid.shape, key + ".shape", report);
  const auto* table = std::get_if<TableMotionSpec>(&rigid.motion);
  if (table && report.healthy(key + ".motion")) check_table(*table, key + ".motion", report);
  if (half && scene.dimension == 3 && turns(rigid.motion) && report.healthy("dimension"))
    report.add(key + ".motion", "a rotation of a half_space", "a translation, or a table of displacements");
}

/// Points of the outline of what touches, as drawn; none if that cannot be told.
std::vector<Point> drawn_outline(const Scene& scene, const ContactPair& pair) {
  const bool bare = pair.kind == ContactPair::Kind::body_on_rigid;
  const MembraneSpec* membrane = bare ? nullptr : &find_named(scene.membranes, pair.touching);
  if (membrane && !membrane->points.empty()) return membrane->points;
  const BodySpec* body = find_body(scene, bare ? pair.touching : membrane->body);
  if (!body || !shape_is_sound(body->shape) || std::holds_alternative<HalfPlaneShape>(body->shape)) return {};
  constexpr double points_per_cell = 4;
  return outline(body->shape, finest_spacing(scene.grid) / points_per_cell);
}

/// How deep a corner of a rigid body is inside what touches it [m].
double depth_of(const Scene& scene, const ContactPair& pair, const Point& x) {
  const bool bare = pair.kind == ContactPair::Kind::body_on_rigid;
  const BodySpec* body = find_body(scene, bare ? pair.touching : find_named(scene.membranes, pair.touching).body);
  if (!body || !shape_is_sound(body->shape) || !contains(body->shape, x)) return 0;
  double depth = distance_to_outline(body->shape, x);
  for (const std::string& name : body->minus)
    if (const BodySpec* cut = find_body(scene, name); cut && shape_is_sound(cut->shape))
      depth = contains(cut->shape, x) ? 0 : std::min(depth, distance_to_outline(cut->shape, x));
  return depth;
}

void check_start(const Scene& scene, const ContactPair& pair, const std::string& key, Report& report) {
  constexpr double allowed_share = 0.1;  // of a cell
  const double allowed = allowed_share * finest_spacing(scene.grid);
  const RigidSurface surface(make_rigid_body(find_named(scene.rigid, pair.other), scene.grid));
  double deepest = 0;
  for (const Point& x : drawn_outline(scene, pair)) {
    const auto gap = surface.gap(Vec<2>(x.data()), 0);
    if (gap) deepest = std::max(deepest, -gap->size);
  }
  for (const Vec<2>& corner : surface.corners())
    deepest = std::max(deepest, depth_of(scene, pair, {corner[0], corner[1]}));
  if (deepest > allowed)
    report.add(key + ".between",
               '"' + pair.touching + "\" up to " + to_text(deepest) + " m inside \"" + pair.other + '"',
               "something that starts outside, or at most a tenth of a cell, " + to_text(allowed) + " m, inside");
}

/// Two membranes in space: with a body in each, neither of which starts inside the other.
void check_membranes_in_space(const Scene& scene, const ContactPair& pair, const std::string& key, Report& report) {
  const MembraneSpec &one = find_named(scene.membranes, pair.touching),
                     &other = find_named(scene.membranes, pair.other);
  if (&one == &other)
    return report.add(key + ".between", "the folds of \"" + one.name + "\" in space", "two membranes");
  for (const MembraneSpec* membrane : {&one, &other})
    if (body_inside(scene, *membrane).empty())
      return report.add(key + ".between", '"' + membrane->name + "\", which is empty, on a membrane",
                        "membranes around bodies of shape `inside`");
  if (!one.drawn.region || !other.drawn.region) return;
  const auto meets = [](const MembraneSpec& of, const MembraneSpec& in) {
    const std::vector<Corner>& points = of.drawn.cloth->points;
    return std::ranges::any_of(points, [&](const Corner& x) { return in.drawn.region->contains(x); });
  };
  if (meets(one, other) || meets(other, one))
    report.add(key + ".between", '"' + one.name + "\" partly inside \"" + other.name + '"',
               "membranes that start apart");
}

/// In space only membranes touch.
void check_in_space(const Scene& scene, const ContactPair& pair, const std::string& key, Report& report) {
  if (pair.kind == ContactPair::Kind::membranes) return check_membranes_in_space(scene, pair, key, report);
  if (pair.kind != ContactPair::Kind::membrane_on_rigid) {
    report.add(key + ".between", '"' + pair.touching + "\" and \"" + pair.other + "\" in space",
               "a membrane and a rigid body, or two membranes");
    return;
  }
  const MembraneSpec& membrane = find_named(scene.membranes, pair.touching);
  const SpaceSurface surface(make_rigid_body(find_named(scene.rigid, pair.other)));
  if (!membrane.drawn.cloth) return;
  const double allowed = finest_spacing(scene.grid) / 10;
  double deepest = 0;
  for (const Corner& x : membrane.drawn.cloth->points)
    if (const auto depth = surface.depth(Vec<3>(x.data()))) deepest = std::max(deepest, depth->size);
  if (deepest > allowed)
    report.add(key + ".between",
               '"' + pair.touching + "\" up to " + to_text(deepest) + " m inside \"" + pair.other + '"',
               "something that starts outside, or at most a tenth of a cell, " + to_text(allowed) + " m, inside");
}

constexpr const char* who_may_touch =
    "a membrane, or a body without one, and a rigid body; two membranes; or in the plane one membrane twice for its "
    "own folds";

/// The pair of a contact with two names that are there.
bool check_pair(const Scene& scene, const ContactSpec& contact, const std::string& key, Report& report) {
  if (contact.between[0].empty()) {
    report.add(key, "another number of names than two", who_may_touch);
    return false;
  }
  std::vector<std::string> known = names_of(scene.membranes);
  for (const auto& names : {names_of(scene.bodies), names_of(scene.rigid)})
    known.insert(known.end(), names.begin(), names.end());
  for (const std::string& name : contact.between)
    if (!check_reference(key, name, known, "membranes, bodies or rigid", report)) return false;
  if (contact_pair(scene, contact).kind != ContactPair::Kind::none) return true;
  report.add(key, '"' + contact.between[0] + "\" and \"" + contact.between[1] + '"', who_may_touch);
  return false;
}

}  // namespace

void check_contacts(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.rigid.size(); ++i)
    check_rigid(scene, scene.rigid[i], report.element("rigid", i), report);
  std::set<std::pair<std::string, std::string>> pairs;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const ContactSpec& contact = scene.contacts[i];
    const std::string& key = report.element("contacts", i);
    if (!report.healthy(key + ".between") || !check_pair(scene, contact, key + ".between", report)) continue;
    const ContactPair pair = contact_pair(scene, contact);
    if (!pairs.insert(std::minmax(pair.touching, pair.other)).second)
      report.add(key + ".between", "a pair that has a contact already", "each pair once");
    if (pair.kind == ContactPair::Kind::membranes && scene.dimension == 2) continue;
    const auto healthy = [&](const char* part) { return report.healthy(part); };
    constexpr const char* needed[] = {"rigid", "membranes", "grid", "dimension", "bodies"};
    if (!std::all_of(std::begin(needed), std::end(needed), healthy)) continue;
    if (scene.dimension == 2) check_start(scene, pair, key, report);
    if (scene.dimension == 3) check_in_space(scene, pair, key, report);
  }
}

}  // namespace geodrop
