#include "interface_contacts.hpp"

#include <geodrop/base/find_named.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/value_at.hpp"
#include "bed_beside.hpp"
#include "cells_around.hpp"
#include "clipped_cells.hpp"
#include "cut_cells.hpp"
#include "grid/point_support.hpp"
#include "membrane/outline.hpp"
#include "membrane/part_size.hpp"
#include "membrane/triangles.hpp"
#include "outline_pieces.hpp"
#include "wet_cells.hpp"

namespace geodrop {
namespace {

/// Mean over a stretch of the effective pressure inside.
double pressure_inside(const Membrane<2>& membrane, const CutCells& cells, const Stretch& stretch) {
  const Array<double>& pressure = membrane.contents_pressure;
  double sum = 0;
  for_each_piece(cells, stretch, [&](const CutCells::Piece& piece) {
    const std::size_t start = piece.edge, end = end_of_edge(start, membrane.nodes());
    const double middle = 0.5 * (piece.from + piece.to);
    sum += length_of(membrane, piece) * ((1 - middle) * pressure[start] + middle * pressure[end]);
  });
  return stretch.size > 0 ? sum / stretch.size : 0;
}

/// Velocity of a field at a place by its nodes that have mass; empty where most of the splines are of others.
template <int Dim>
std::optional<Vec<Dim>> velocity_at(const Grid<Dim>& grid, const Vec<Dim>& x) {
  const GridLayout<Dim>& layout = grid.layout;
  std::array<double, Dim> place;
  for (int a = 0; a < Dim; ++a) {
    place[a] = x[a];
    if (!layout.periodic(a) && !(place[a] >= layout.lower[a] && place[a] <= layout.upper[a])) return {};
  }
  Vec4 sum{};
  double weights = 0;
  PointSupport<Dim>(layout, place, 0).for_each_node(layout, [&](int node, double weight) {
    if (!(grid.sum[node][3] > 0)) return;
    sum += weight * grid.velocity[node];
    weights += weight;
  });
  if (weights < 0.5) return {};
  sum /= weights;
  Vec<Dim> velocity;
  for (int a = 0; a < Dim; ++a) velocity[a] = sum[a];
  return velocity;
}

/// The middle of a stretch, its outward normal as long as it is large, and the least width of its cells [m].
template <int Dim>
struct Facing {
  Vec<Dim> middle, normal;
  double width;
};

Facing<2> facing(const GridLayout<2>& layout, const Membrane<2>& membrane, const CutCells& cells,
                 const Stretch& stretch) {
  Facing<2> out{Vec<2>::Zero(), Vec<2>::Zero(), std::numeric_limits<double>::infinity()};
  for_each_piece(cells, stretch, [&](const CutCells::Piece& piece) {
    const std::size_t from = piece.edge, to = end_of_edge(from, membrane.nodes());
    const double share = 0.5 * (piece.from + piece.to), length = length_of(membrane, piece);
    std::array<double, 2> way;
    for (int a = 0; a < 2; ++a) {
      way[a] = (piece.to - piece.from) * (membrane.x[a][to] - membrane.x[a][from]);
      out.middle[a] += length * (membrane.x[a][from] + share * (membrane.x[a][to] - membrane.x[a][from]));
    }
    out.normal[0] += cells.sense * way[1];
    out.normal[1] -= cells.sense * way[0];
    out.width = std::min(out.width, least_width(layout, flat_of(layout, cells, piece.cell)));
  });
  if (stretch.size > 0)
    for (int a = 0; a < 2; ++a) out.middle[a] /= stretch.size;
  return out;
}

Facing<3> facing(const GridLayout<3>& layout, const Membrane<3>& membrane, const ClippedSurface& cells,
                 const Stretch& stretch) {
  Facing<3> out{Vec<3>::Zero(), Vec<3>::Zero(), std::numeric_limits<double>::infinity()};
  double area = 0;
  for_each_piece(cells, stretch, [&](const ClippedCells::Piece& piece) {
    const double size = size_of(membrane, piece.triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      const double part = size * piece.share[k];
      out.middle += part * corner_of(membrane, piece.triangle, k);
      area += part;
    }
  });
  for (std::size_t k = stretch.first; k < stretch.first + stretch.count; ++k) {
    for (int a = 0; a < 3; ++a)
      out.normal[a] += layout.h * layout.h * cells.flanks[k].normal[static_cast<std::size_t>(a)];
    out.width = std::min(out.width, least_width(layout, flat_of(layout, cells, cells.flanks[k].cell)));
  }
  if (area > 0) out.middle /= area;
  return out;
}

/// What of a velocity is along a membrane with the unit normal n.
double size_along(const Vec<2>& velocity, const Vec<2>& n) { return std::abs(velocity[1] * n[0] - velocity[0] * n[1]); }
double size_along(const Vec<3>& velocity, const Vec<3>& n) { return (velocity - velocity.dot(n) * n).norm(); }

/// The velocity of slipping beyond the layer of 1.5 to 2 cells beside the membrane, which the grid slows down: with
/// that at the membrane the friction of a flat plate came out as half of what it is.
template <int Dim>
void look_outside(const Grids<Dim>& grids, const Facing<Dim>& facing, Contact<Dim>& contact) {
  constexpr double cells_away = 1.75;
  contact.distance = 0.5 * facing.width;
  const double size = std::sqrt(facing.normal.squaredNorm());
  if (!(size > 0 && contact.stretch.size > 0)) return;
  const Vec<Dim> normal = facing.normal / size;
  const double away = cells_away * facing.width;
  const auto water = velocity_at<Dim>(grids.front(), facing.middle + away * normal);
  const auto own = velocity_at<Dim>(grids[contact.membrane->field], facing.middle);
  if (!water || !own) return;
  contact.velocity = size_along(Vec<Dim>(*water - *own), normal);
  contact.distance = away;
}

/// The axes of a stretch in space; the first along it is square to the axis of the grid that it faces least.
void set_axes(const Facing<3>& facing, Contact<3>& contact) {
  constexpr double least_projection = 0.5;  // of the area: what is bent more has no direction
  const double size = contact.stretch.size, projected = facing.normal.norm();
  const Vec<3> normal = facing.normal.normalized();
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec<3> first = normal.cross(Vec<3>::Unit(least)).normalized(), second = normal.cross(first);
  const Vec<3> enlarged = size / std::max(projected, least_projection * size) * normal;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto k = static_cast<Eigen::Index>(a);
    contact.axes[0][a] = enlarged[k], contact.axes[1][a] = first[k], contact.axes[2][a] = second[k];
  }
}
void set_axes(const Facing<2>&, Contact<2>&) {}

/// The effective pressure of soil inside that a membrane in the plane slides over.
void look_inside(const CutCells& cells, Contact<2>& contact) {
  if (contact.over_soil()) contact.inside = pressure_inside(*contact.membrane, cells, contact.stretch);
}
void look_inside(const ClippedSurface&, Contact<3>&) {}

/// Mean over a stretch of the permeance of its segments or triangles.
template <int Dim>
double permeance_over(const Outline<Dim>& cells, const Contact<Dim>& contact) {
  const Membrane<Dim>& membrane = *contact.membrane;
  if (membrane.permeance_strains.empty()) return membrane.permeance;
  double sum = 0, shares = 0;
  for_each_share(cells, contact.stretch, [&](std::size_t at, double share) {
    sum += share * permeance_of(membrane, at);
    shares += share;
  });
  return shares > 0 ? sum / shares : 0.0;
}

std::size_t corner_of_part(const Membrane<2>& membrane, std::size_t segment, int k) {
  return k == 0 ? segment : end_of_edge(segment, membrane.nodes());
}
std::size_t corner_of_part(const Membrane<3>& membrane, std::size_t triangle, int k) {
  return membrane.triangles.corner[static_cast<std::size_t>(k)][triangle];
}

/// Nodes of a membrane that lie on rigid bodies.
template <int Dim>
std::vector<bool> nodes_on_rigid(const State<Dim>& state, const Membrane<Dim>& membrane) {
  std::vector<bool> touches(membrane.nodes(), false);
  for (const RigidContact<Dim>& contact : state.rigid_contacts)
    if (!contact.bare && contact.touching == membrane.name)
      for (const std::uint32_t node : contact.points) touches[node] = true;
  return touches;
}

/// Length or area of a stretch whose segments or triangles have all of their nodes on rigid bodies.
template <int Dim>
double size_on_rigid(const Outline<Dim>& cells, const std::vector<bool>& touches, const Contact<Dim>& contact) {
  const Membrane<Dim>& membrane = *contact.membrane;
  double size = 0;
  for_each_share(cells, contact.stretch, [&](std::size_t part, double share) {
    bool lies = true;
    for (int k = 0; k < Dim; ++k) lies = lies && touches[corner_of_part(membrane, part, k)];
    if (lies) size += share * size_of(membrane, part);
  });
  return size;
}

/// What is beside a stretch.
template <int Dim>
void look_beside(const Grids<Dim>& grids, const Outline<Dim>& cells, const BedCells& bed, Contact<Dim>& contact) {
  const Membrane<Dim>& membrane = *contact.membrane;
  if (!membrane.bed.empty()) look_for_bed(grids.front(), cells, bed, contact);
  const bool has_axes = Dim == 3 && (contact.rubs() || contact.sticks());
  if (has_axes || membrane.shear == Shear::rough_wall) {
    const Facing<Dim> faces = facing(grids.front().layout, membrane, cells, contact.stretch);
    if (membrane.shear == Shear::rough_wall) look_outside(grids, faces, contact);
    set_axes(faces, contact);
  }
  look_inside(cells, contact);
  contact.permeance = permeance_over(cells, contact);
}

/// Whether a dry stretch lies in air: no body beside it, and some of it off rigid bodies, which alone lets water
/// through. Where the water inside presses on it some flows out, else air may come in.
template <int Dim>
void look_for_air(const Grids<Dim>& grids, const Outline<Dim>& cells, const std::vector<bool>& touches,
                  Contact<Dim>& contact) {
  const Grid<Dim>&around = grids.front(), &water = grids[grids[contact.membrane->field].pore_water];
  double pressure = 0;
  for_each_cell_of(cells, contact.stretch, [&](int cell) {
    const int flat = flat_of(around.layout, cells, cell);
    contact.in_air = contact.in_air || is_in_air(around, flat);
    pressure += water.cell_pressure[flat];
  });
  const double bare = contact.in_air ? 1 - size_on_rigid(cells, touches, contact) / contact.stretch.size : 0;
  contact.in_air = bare > 1e-9;  // round-off
  if (!contact.in_air) return;
  contact.permeance = bare * permeance_over(cells, contact);
  contact.lets_air_in = !(pressure > 0);
}

}  // namespace

template <int Dim>
double permeance_of(const Membrane<Dim>& membrane, std::size_t segment) {
  if (membrane.permeance_strains.empty()) return membrane.permeance;
  return membrane.permeance *
         value_at(membrane.strain[segment], membrane.permeance_strains, membrane.permeance_factors);
}

namespace {

/// Adds to what acts across a membrane, that of the grains of a bed to the whole, too.
template <int Dim>
void add_across(Says says, std::size_t part, double traction, Membrane<Dim>& membrane) {
  (says == Says::through ? membrane.pore_pressure : membrane.water_pressure)[part] += traction;
  if (says == Says::grains) membrane.bed_pressure[part] += traction;
}

/// The last traction of a row across a membrane.
template <int Dim>
double traction_across(Says says, std::size_t part, const Membrane<Dim>& membrane) {
  if (says == Says::through) return membrane.pore_pressure[part];
  const double of_grains = membrane.bed_pressure.empty() ? 0.0 : membrane.bed_pressure[part];
  return says == Says::grains ? of_grains : membrane.water_pressure[part] - of_grains;
}

bool is_along(Says says) { return says == Says::tangent || says == Says::second_tangent; }

}  // namespace

/// -p t acts on the membrane, t with the nodes if they run anticlockwise.
void add_traction(const Contact<2>& contact, const CutCells& cells, Says says, std::size_t segment, double traction) {
  Membrane<2>& membrane = *contact.membrane;
  if (!is_along(says)) return add_across(says, segment, traction, membrane);
  membrane.water_shear[segment] += -cells.sense * traction;
  if (contact.lies()) membrane.bed_shear[segment] += -cells.sense * traction;
}

void add_traction(const Contact<3>& contact, const ClippedSurface&, Says says, std::size_t triangle, double traction) {
  Membrane<3>& membrane = *contact.membrane;
  if (!is_along(says)) return add_across(says, triangle, traction, membrane);
  const std::array<double, 3>& along = contact.axes[says == Says::tangent ? 1 : 2];
  for (std::size_t a = 0; a < 3; ++a) membrane.triangles.water_shear[a][triangle] -= traction * along[a];
}

namespace {

double traction_at(const Contact<2>& contact, const CutCells& cells, Says says, std::size_t segment) {
  return is_along(says) ? -cells.sense * contact.membrane->water_shear[segment]
                        : traction_across(says, segment, *contact.membrane);
}
double traction_at(const Contact<3>& contact, const ClippedSurface&, Says says, std::size_t triangle) {
  if (!is_along(says)) return traction_across(says, triangle, *contact.membrane);
  const Vec<3> along(contact.axes[says == Says::tangent ? 1 : 2].data());
  return -vector_at(contact.membrane->triangles.water_shear, triangle).dot(along);
}

}  // namespace

template <int Dim>
double last_traction(const Contact<Dim>& contact, const Outline<Dim>& cells, Says says) {
  double sum = 0;
  for_each_share(cells, contact.stretch, [&](std::size_t part, double share) {
    sum += traction_at(contact, cells, says, part) * (share * size_of(*contact.membrane, part));
  });
  return contact.stretch.size > 0 ? sum / contact.stretch.size : 0;
}

template <int Dim>
void forget_tractions(Membrane<Dim>& membrane) {
  for (Array<double>* traction : {&membrane.water_pressure, &membrane.water_shear, &membrane.bed_shear,
                                  &membrane.bed_pressure, &membrane.pore_pressure, &membrane.seepage})
    std::fill(traction->begin(), traction->end(), 0.0);
  if constexpr (Dim == 3)
    for (Array<double>& component : membrane.triangles.water_shear) std::fill(component.begin(), component.end(), 0.0);
}

template <int Dim>
std::vector<Contact<Dim>> find_contacts(State<Dim>& state, const Grids<Dim>& grids) {
  std::vector<Contact<Dim>> contacts;
  const Grid<Dim>& around = grids.front();
  for (Membrane<Dim>& membrane : state.membranes) {
    if (!acts_sharply(membrane)) continue;
    const Outline<Dim>& cells = grids[membrane.field].outline;
    const std::size_t first = contacts.size();
    for (const Stretch& stretch : stretches_of(around, membrane, cells)) contacts.push_back({&membrane, stretch});
    const BedCells bed = membrane.bed.empty() ? BedCells{} : bed_around(state, around, membrane, cells);
    const std::vector<bool> touches = membrane.permeance > 0 ? nodes_on_rigid(state, membrane) : std::vector<bool>();
    for (std::size_t c = first; c < contacts.size(); ++c)
      if (contacts[c].stretch.wet)
        look_beside(grids, cells, bed, contacts[c]);
      else if (membrane.permeance > 0)
        look_for_air(grids, cells, touches, contacts[c]);
  }
  return contacts;
}

#define GEODROP_INSTANTIATE(D)                                                  \
  template double permeance_of(const Membrane<D>&, std::size_t);                \
  template double last_traction<D>(const Contact<D>&, const Outline<D>&, Says); \
  template void forget_tractions(Membrane<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE
template std::vector<Contact<2>> find_contacts(State<2>&, const Grids<2>&);
template std::vector<Contact<3>> find_contacts(State<3>&, const Grids<3>&);

}  // namespace geodrop
