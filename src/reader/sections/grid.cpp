// The grid and the walls of its domain.
#include "sections.hpp"

namespace geodrop {
namespace {

constexpr Range growth_range{"> 1 and <= 1.5", [](double x) { return x > 1 && x <= 1.5; }};

}  // namespace

// clang-format off
SectionOf<RefineSpec> grid_refine_section() {
  constexpr RowsOf<RefineSpec> key;
  return {
      "[[grid.refine]]", "axis",
      "Finer cells along an axis, at most one zone each, with basis = \"bspline2\" only. Outside of the zone cells "
      "grow by `growth` from one to the next until they are `spacing` of the grid wide; all are scaled down a "
      "little, so that a whole number of them fits. Where they stand then is no concern of bodies: cells that an "
      "outline cuts get particles of their share. The time step is that of the finest cell, and membranes have "
      "nodes that suit it.",
      R"([[grid.refine]]
axis = "x"
from = -1.5
to = 1.5
spacing = 0.0625)", {
      key("axis", &RefineSpec::axis, {{"x", 0}, {"y", 1}}, required, "along which cells are finer").in(2),
      key("axis", &RefineSpec::axis, {{"x", 0}, {"y", 1}, {"z", 2}}, required, "along which cells are finer").in(3),
      key("from", &RefineSpec::from, "m", required, any, "where the zone begins"),
      key("to", &RefineSpec::to, "m", required, any, "where it ends"),
      key("spacing", &RefineSpec::spacing, "m", required, positive, "width of the cells in the zone, below that of the grid"),
      key("growth", &RefineSpec::growth, "", standard("1.1"), growth_range, "width of a cell over that of the next finer one, outside of the zone"),
  }};
}

SectionOf<GridSpec> grid_section() {
  constexpr RowsOf<GridSpec> key;
  return {
      "[grid]", "",
      "The domain and its cells. Walls stand on the domain's edges, which are grid lines.",
      R"([grid]
lower = [-3.0, -1.0]
upper = [3.0, 7.0]
spacing = 0.125)", {
      key("lower", &GridSpec::lower, "m", required, any, "lower corner of the domain"),
      key("upper", &GridSpec::upper, "m", required, any, "upper corner of the domain"),
      key("spacing", &GridSpec::spacing, "m", required, positive, "cell size h; it divides the domain (along axes that are not refined)"),
      key("basis", &GridSpec::basis, {{"bspline2", Basis::bspline2}, {"gimp", Basis::gimp}, {"linear", Basis::linear}, {"tri3", Basis::tri3}, {"tet4", Basis::tet4}}, standard("\"bspline2\""), "shape functions: quadratic B-splines; hat functions averaged over the particles' domains (uGIMP); hat functions; cells split into linear triangles (2D) or tetrahedra (3D)"),
      key.list("refine", &GridSpec::refine, grid_refine_section(), standard("[]"), "zones of finer cells"),
  }};
}

SectionOf<WallsSpec> walls_section() {
  constexpr RowsOf<WallsSpec> key;
  constexpr auto lower = [](WallsSpec& walls, WallKind kind) { walls.lower.push_back(kind); };
  constexpr auto upper = [](WallsSpec& walls, WallKind kind) { walls.upper.push_back(kind); };
  return {
      "[walls]", "",
      "How the four sides of the domain (3D: six) hold what touches them. The last axis is the vertical one, so "
      "bottom and top are the ends of y in 2D and of z in 3D. Walls never let go: no_slip holds material in all "
      "directions, slip in the normal one, also where it would pull away (there is no separation). Of two opposite "
      "walls both or neither are periodic: what leaves on one side comes in at the other. Such an axis has at least "
      "5 cells, and the scene no membranes. Between two sorts particles may be up to a cell beyond a periodic wall; "
      "positions of tracers run on across it.",
      R"([walls]
left = "slip"
right = "slip"
bottom = "no_slip"
top = "slip")", {
      key("left", lower, {{"slip", WallKind::slip}, {"no_slip", WallKind::no_slip}, {"periodic", WallKind::periodic}}, required, "wall at the lower x; never lets go"),
      key("right", upper, {{"slip", WallKind::slip}, {"no_slip", WallKind::no_slip}, {"periodic", WallKind::periodic}}, required, "wall at the upper x; never lets go"),
      key("front", lower, {{"slip", WallKind::slip}, {"no_slip", WallKind::no_slip}, {"periodic", WallKind::periodic}}, required, "wall at the lower y; never lets go").in(3),
      key("back", upper, {{"slip", WallKind::slip}, {"no_slip", WallKind::no_slip}, {"periodic", WallKind::periodic}}, required, "wall at the upper y; never lets go").in(3),
      key("bottom", lower, {{"slip", WallKind::slip}, {"no_slip", WallKind::no_slip}, {"periodic", WallKind::periodic}}, required, "wall at the lower y (3D: z); never lets go"),
      key("top", upper, {{"slip", WallKind::slip}, {"no_slip", WallKind::no_slip}, {"periodic", WallKind::periodic}}, required, "wall at the upper y (3D: z); never lets go"),
  }};
}
// clang-format on

}  // namespace geodrop
