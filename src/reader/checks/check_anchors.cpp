// Checks of anchors: a node that is there, on a membrane that can hang.
#include "check_scene.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/geometry/triangle_surface.hpp>
#include <geodrop/grid/graded_axis.hpp>

#include <algorithm>
#include <cmath>
#include <set>

#include "membrane/membrane_nodes.hpp"

namespace geodrop {
namespace {

std::vector<Point> nodes_of(const Scene& scene, const MembraneSpec& membrane) {
  if (scene.dimension == 2) return membrane_nodes(scene, membrane);
  std::vector<Point> nodes;
  if (membrane.drawn.cloth)
    for (const Corner& x : membrane.drawn.cloth->points) nodes.emplace_back(x.begin(), x.end());
  return nodes;
}

/// The nearest node; whether it can be held.
bool check_node(const Scene& scene, const AnchorSpec& anchor, const std::string& key, std::size_t& nearest,
                Report& report) {
  const MembraneSpec& membrane = find_named(scene.membranes, anchor.membrane);
  const std::vector<Point> nodes = nodes_of(scene, membrane);
  if (nodes.empty()) return false;
  const double h = finest_spacing(scene.grid), spacing = h / membrane.segments_per_cell;
  nearest = 0;
  for (std::size_t k = 1; k < nodes.size(); ++k)
    if (distance(nodes[k], anchor.point) < distance(nodes[nearest], anchor.point)) nearest = k;
  const double off = distance(nodes[nearest], anchor.point);
  if (off > spacing) {
    report.add(key + ".at", to_text(anchor.point) + ", " + to_text(off) + " m from \"" + membrane.name + '"',
               "a point of the membrane as drawn, at most " + to_text(spacing) + " m from a node of it");
    return false;
  }
  constexpr double cells = 2;
  for (std::size_t a = 0; a < anchor.point.size(); ++a) {
    const double x = anchor.point[a], room = cells * scene.grid.spacing;
    if (x >= scene.grid.lower[a] + room && x <= scene.grid.upper[a] - room) continue;
    report.add(
        key + ".at", to_text(anchor.point) + " beside a side of the domain",
        "a point two cells, " + to_text(room) + " m, or more from it; a wall with \"no_slip\" holds what is there");
    return false;
  }
  return true;
}

void check_line(const AnchorSpec& anchor, const std::string& key, Report& report) {
  const auto* line = std::get_if<AnchorLineSpec>(&anchor.by);
  if (line && line->to.size() == anchor.point.size() && distance(line->to, anchor.point) == 0)
    report.add(key + ".to", to_text(line->to) + ", where the membrane is", "another point, or type = \"held\"");
}

}  // namespace

void check_anchors(const Scene& scene, Report& report) {
  std::set<std::pair<std::string, std::size_t>> held;
  for (std::size_t i = 0; i < scene.anchors.size(); ++i) {
    const AnchorSpec& anchor = scene.anchors[i];
    const std::string& key = report.element("anchors", i);
    if (!report.healthy(key + ".membrane") ||
        !check_reference(key + ".membrane", anchor.membrane, names_of(scene.membranes), "membranes", report))
      continue;
    constexpr const char* needed[] = {"membranes", "bodies", "grid", "dimension", "materials"};
    if (!report.healthy(key) ||
        !std::all_of(std::begin(needed), std::end(needed), [&](const char* part) { return report.healthy(part); }))
      continue;
    check_line(anchor, key, report);
    std::size_t node = 0;
    if (check_node(scene, anchor, key, node, report) && !held.insert({anchor.membrane, node}).second)
      report.add(key + ".at", "a node of \"" + anchor.membrane + "\" that has an anchor already", "each node once");
  }
}

}  // namespace geodrop
