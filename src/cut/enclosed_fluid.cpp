#include "enclosed_fluid.hpp"

#include <algorithm>
#include <cmath>

#include "cells_around.hpp"
#include "clipped_cells.hpp"
#include "cut_cells.hpp"
#include "geometry/polygon.hpp"
#include "grid/blocks.hpp"
#include "grid/nearby_cells.hpp"
#include "membrane/fluid_load.hpp"
#include "membrane/membrane_force.hpp"
#include "membrane/surface_load.hpp"
#include "membrane/triangles.hpp"
#include "transfer/kernels.hpp"
#include "transfer/slabs.hpp"

namespace geodrop {
namespace {

/// f(body, its membrane, its cells) for all enclosed bodies of a velocity field.
template <class State, class Grid, class F>
void for_each_enclosed(State& state, Grid& grid, F&& f) {
  for (auto& body : state.bodies) {
    if (body.field != grid.field || body.pressure != PressureSupport::enclosed) continue;
    const auto membrane = std::find_if(state.membranes.begin(), state.membranes.end(),
                                       [&](const auto& m) { return m.closed && m.body == body.name; });
    f(body, *membrane, grid.enclosed[body.enclosed]);
  }
}

/// A cell stands by itself if this share of it lies inside and is filled.
constexpr double least_inside = 0.5, least_content = 0.3;

/// Of the plane or of space.
template <int Dim>
const auto& box_of(const EnclosedCells& cells) {
  if constexpr (Dim == 2)
    return static_cast<const CutCells&>(cells);
  else
    return cells.space;
}

/// Local coordinates of a local cell.
template <std::size_t dim>
std::array<int, dim> place_of(const std::array<int, dim>& count, int cell) {
  std::array<int, dim> at;
  for (std::size_t a = 0; a < dim; ++a) {
    at[a] = cell % count[a];
    cell /= count[a];
  }
  return at;
}

/// The local cell at an offset from a place, -1 outside of the box.
template <std::size_t dim>
int neighbour_at(const std::array<int, dim>& count, const std::array<int, dim>& at,
                 const std::array<int, dim>& offset) {
  int cell = 0;
  for (std::size_t a = dim; a-- > 0;) {
    const int i = at[a] + offset[a];
    if (i < 0 || i >= count[a]) return -1;
    cell = cell * count[a] + i;
  }
  return cell;
}

/// A cell that does not stand by itself joins the nearest that does. Local indices.
template <int Dim>
void choose_hosts(double cell_volume, EnclosedCells& cells) {
  static const auto nearby = offsets_by_distance<Dim>();  // a thin tube has no host any nearer
  const auto& box = box_of<Dim>(cells);
  const auto stands = [&](int c) {
    return inside_of(box)[c] >= least_inside && cells.volume[c] >= least_content * cell_volume;
  };
  const int n = static_cast<int>(box.size());
  cells.host.resize(box.size());
  for (int c = 0; c < n; ++c) {
    cells.host[c] = c;
    if (stands(c)) continue;
    const auto at = place_of(box.count, c);
    for (const auto& offset : nearby) {
      const int other = neighbour_at(box.count, at, offset);
      if (other < 0 || !stands(other)) continue;
      cells.host[c] = other;
      break;
    }
  }
}

/// Moves what the cells hold to their hosts.
void sum_into_hosts(const EnclosedCells& cells, Array<double>& values) {
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (cells.host[c] == static_cast<int>(c)) continue;
    values[cells.host[c]] += values[c];
    values[c] = 0;
  }
}

/// f(p, local cell) for the particles of a body within the box.
template <int Dim, class F>
void for_each_particle(const Body<Dim>& body, const GridLayout<Dim>& layout, const EnclosedCells& cells, F&& f) {
  for (std::size_t p = 0; p < body.size(); ++p)
    if (const int cell = local_cell(layout, box_of<Dim>(cells), vector_at(body.x, p)); cell >= 0) f(p, cell);
}

template <int Dim>
void sum_particles(const Body<Dim>& body, const GridLayout<Dim>& layout, EnclosedCells& cells) {
  const auto& fluid = std::get<Newtonian>(body.material);
  cells.volume.assign(box_of<Dim>(cells).size(), 0.0);
  cells.pressure.assign(box_of<Dim>(cells).size(), 0.0);
  for_each_particle(body, layout, cells, [&](std::size_t p, int c) {
    const double volume = body.volume(p);
    cells.volume[c] += volume;
    cells.pressure[c] += volume * fluid.bulk_modulus * (1 / body.J[p] - 1);
  });
}

/// A face between two cells of different hosts: local cells, the nodes below it along its axis (those above are
/// `across` further on), int N over the part inside for either [m, m2].
template <int Dim>
struct Face {
  static constexpr std::size_t nodes = Dim == 2 ? 3 : 9;
  int below, above, axis, across;
  std::array<int, nodes> node;
  std::array<double, nodes> weight;
};

template <class F>
void for_each_face(const GridLayout<2>& layout, const EnclosedCells& cells, F&& f) {
  const auto [nx, ny] = cells.count;
  for (int axis = 0; axis < 2; ++axis) {
    const Array<FaceMoments>& faces = axis == 0 ? cells.right_face : cells.top_face;
    const int to_above = axis == 0 ? 1 : nx;
    for (int j = 0; j < ny - axis; ++j)
      for (int i = 0; i < nx - 1 + axis; ++i) {
        const int c = i + j * nx;
        if (faces[c][0] <= 0 || cells.host[c] == cells.host[c + to_above]) continue;
        Face<2> face{c, c + to_above, axis, layout.stride[axis], {}, face_integrals(faces[c])};
        const int flat = flat_of(layout, cells, c);
        for (int n = 0; n < 3; ++n) {
          face.node[n] = flat + (n - 1) * layout.stride[1 - axis];
          face.weight[n] *= 0.5 * layout.h;  // N across is 1/2 for both
        }
        f(face);
      }
  }
}

template <class F>
void for_each_face(const GridLayout<3>& layout, const EnclosedCells& cells, F&& f) {
  const ClippedCells& space = cells.space;
  const std::array<int, 3> local{1, space.count[0], space.count[0] * space.count[1]};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    for (int c = 0; c < static_cast<int>(space.size()); ++c) {
      const ClippedCells::FaceMoments& moments = space.upper_face[axis][c];
      if (!(moments[0] > 0) || cells.host[c] == cells.host[c + local[axis]]) continue;
      Face<3> face{c, c + local[axis], axis, layout.stride[axis], {}, face_integrals(moments)};
      const int flat = flat_of(layout, space, c);
      for (int n = 0; n < 9; ++n) {
        face.node[n] = flat + (n % 3 - 1) * layout.stride[u] + (n / 3 - 1) * layout.stride[w];
        face.weight[n] *= 0.5 * layout.h * layout.h;  // N across is 1/2 for both
      }
      f(face);
    }
  }
}

/// f(node, weight) for the nodes of a face, on both sides of it.
template <int Dim, class F>
void for_each_node(const Face<Dim>& face, F&& f) {
  for (std::size_t n = 0; n < Face<Dim>::nodes; ++n)
    for (const int node : {face.node[n], face.node[n] + face.across}) f(node, face.weight[n]);
}

/// pi below a face less that above it [Pa].
template <int Dim>
double jump_at(const Face<Dim>& face, const EnclosedCells& cells) {
  return cells.pressure[cells.host[face.below]] - cells.pressure[cells.host[face.above]];
}

/// Share of the wave speed at which differences of pi even out from cell to cell, and of J within a cell.
constexpr double evening = 0.1;

/// J of particles moves by `share` towards the mean of their cell; the volume of the cell stays.
template <int Dim>
void even_out(Body<Dim>& body, const GridLayout<Dim>& layout, double share, const EnclosedCells& cells) {
  Array<double> rest(box_of<Dim>(cells).size(), 0.0);
  for_each_particle(body, layout, cells,
                    [&](std::size_t p, int c) { rest[cells.host[c]] += body.volume(p) / body.J[p]; });
  for_each_particle(body, layout, cells, [&](std::size_t p, int c) {
    const int host = cells.host[c];
    body.J[p] += share * (cells.volume[host] / rest[host] - body.J[p]);
  });
}

/// Adds the flow out of the cells with the nodes of the membrane.
void add_flow(const Membrane<2>& membrane, const Grid<2>& grid, const EnclosedCells& cells, Array<double>& flow) {
  const auto v = node_velocities(membrane, grid);
  const auto& [x, y] = membrane.x;
  for (const CutCells::Piece& piece : cells.pieces) {
    const std::size_t k = piece.edge, next = end_of_edge(k, membrane.nodes());
    const double normal[] = {cells.sense * (y[next] - y[k]), cells.sense * (x[k] - x[next])};
    const double of_end = 0.5 * (piece.to * piece.to - piece.from * piece.from),
                 of_start = piece.to - piece.from - of_end;
    for (int a = 0; a < 2; ++a) flow[piece.cell] += normal[a] * (of_start * v[a][k] + of_end * v[a][next]);
  }
}

/// Area times outward unit normal of each triangle [m2].
Vec<3> area_vector(const Membrane<3>& membrane, std::size_t triangle) { return 0.5 * normal_of(membrane, triangle); }

void add_flow(const Membrane<3>& membrane, const Grid<3>& grid, const EnclosedCells& cells, Array<double>& flow) {
  const auto v = node_velocities(membrane, grid);
  for (const ClippedCells::Piece& piece : cells.space.pieces) {
    const Vec<3> area = area_vector(membrane, piece.triangle);
    for (std::size_t k = 0; k < 3; ++k)
      flow[piece.cell] += piece.share[k] * area.dot(vector_at(v, membrane.triangles.corner[k][piece.triangle]));
  }
}

/// Flow out of the cells through faces and membrane, of velocities and of evening pressures [m2/s, m3/s].
template <int Dim>
Array<double> outflow(const Body<Dim>& body, const Membrane<Dim>& membrane, const Grid<Dim>& grid,
                      const EnclosedCells& cells) {
  const auto& fluid = std::get<Newtonian>(body.material);
  const double conductance = evening * std::sqrt(fluid.bulk_modulus / fluid.density) / fluid.bulk_modulus;
  Array<double> flow(box_of<Dim>(cells).size(), 0.0);
  for_each_face(grid.layout, cells, [&](const Face<Dim>& face) {
    const double jump = jump_at(face, cells);
    double through = 0;
    for_each_node(face, [&](int node, double weight) {
      through += weight * (grid.velocity[node][face.axis] + conductance * jump);
    });
    flow[face.below] += through;
    flow[face.above] -= through;
  });
  add_flow(membrane, grid, cells, flow);
  return flow;
}

/// Adds m `lift` of the enclosed fluids to the nodes.
template <int Dim>
void take_gravity(const State<Dim>& state, const Grid<Dim>& grid, const std::array<double, Dim>& lift,
                  Array<Vec4>& target) {
  const auto is_enclosed = [](const Body<Dim>& body) { return body.pressure == PressureSupport::enclosed; };
  const auto other = [&](const Body<Dim>& body) { return body.field == grid.field && !is_enclosed(body); };
  if (std::none_of(state.bodies.begin(), state.bodies.end(), other)) {
    // So far all mass on the nodes is theirs, which spares a third of a step of summing it up again.
    for_each_active_row(grid, [&](int begin, int count, const auto&) {
      for (int node = begin; node < begin + count; ++node)
        for (int a = 0; a < Dim; ++a) target[node][a] += lift[a] * grid.sum[node][3];
    });
    return;
  }
  std::array<Array<double>, Dim> lifts;
  const std::size_t n = state.particles();
  for (int a = 0; a < Dim; ++a) lifts[a].assign(n, lift[a]);
  for_each_slab_by_colour(state, grid, [&](const Body<Dim>& body, std::size_t begin, std::size_t end) {
    if (is_enclosed(body)) sum_by_mass<Dim>(body, {pointers(lifts), 0.0}, grid.layout, target.data(), begin, end);
  });
}

void cut(const GridLayout<2>& layout, const Membrane<2>& membrane, EnclosedCells& cells) {
  cut_cells(layout, membrane.x[0], membrane.x[1], cells);
}
void cut(const GridLayout<3>& layout, const Membrane<3>& membrane, EnclosedCells& cells) {
  clip_cells(layout, membrane, cells.space);
}

void add_load(const Body<2>& body, const EnclosedCells& cells, Membrane<2>& membrane) {
  for (const CutCells::Piece& piece : cells.pieces) {
    const double pressure = cells.pressure[cells.host[piece.cell]];
    add_pressure({piece.from, piece.to, pressure, pressure}, cells.sense, piece.edge, membrane);
  }
  const Array<double>& y = membrane.x[1];
  const auto weight = [&](std::size_t k) { return body.unit_weight * (body.weightless_level - y[k]); };
  for (std::size_t k = 0; k < membrane.nodes(); ++k)
    add_pressure({0, 1, weight(k), weight(end_of_edge(k, membrane.nodes()))}, cells.sense, k, membrane);
}

void add_load(const Body<3>& body, const EnclosedCells& cells, Membrane<3>& membrane) {
  for (const ClippedCells::Piece& piece : cells.space.pieces) {
    const Vec<3> push = cells.pressure[cells.host[piece.cell]] * area_vector(membrane, piece.triangle);
    for (std::size_t k = 0; k < 3; ++k)
      for (int a = 0; a < 3; ++a)
        membrane.load[a][membrane.triangles.corner[k][piece.triangle]] += piece.share[k] * push[a];
  }
  add_weight(body.unit_weight, body.weightless_level, membrane);
}

}  // namespace

template <int Dim>
void update_enclosed_cells(const State<Dim>& state, Grid<Dim>& grid) {
  for_each_enclosed(state, grid, [&](const Body<Dim>& body, const Membrane<Dim>& membrane, EnclosedCells& cells) {
    cut(grid.layout, membrane, cells);
    sum_particles(body, grid.layout, cells);
    choose_hosts<Dim>(std::pow(grid.layout.h, Dim), cells);
    sum_into_hosts(cells, cells.volume);
    sum_into_hosts(cells, cells.pressure);
    for (std::size_t c = 0; c < cells.volume.size(); ++c)
      if (cells.volume[c] > 0) cells.pressure[c] /= cells.volume[c];
  });
}

template <int Dim>
void add_fluid_loads(State<Dim>& state, const Grid<Dim>& grid) {
  for_each_enclosed(state, grid, [&](const Body<Dim>& body, Membrane<Dim>& membrane, const EnclosedCells& cells) {
    add_load(body, cells, membrane);
  });
}

template <int Dim>
void enclosed_force_to_grid(const State<Dim>& state, Grid<Dim>& grid, const Point& g, double dt) {
  const bool separate = !grid.force.empty();
  Array<Vec4>& target = separate ? grid.force : grid.sum;
  const double scale = separate ? 1.0 : dt;
  for_each_enclosed(state, grid, [&](const Body<Dim>&, const Membrane<Dim>&, const EnclosedCells& cells) {
    for_each_face(grid.layout, cells, [&](const Face<Dim>& face) {
      const double jump = jump_at(face, cells);
      for_each_node(face, [&](int node, double weight) { target[node][face.axis] += scale * jump * weight; });
    });
  });
  std::array<double, Dim> lift;
  for (int a = 0; a < Dim; ++a) lift[a] = -scale * g[a];
  take_gravity<Dim>(state, grid, lift, target);
}

template <int Dim>
void update_enclosed_rates(State<Dim>& state, Grid<Dim>& grid, double dt) {
  for_each_enclosed(state, grid, [&](Body<Dim>& body, const Membrane<Dim>& membrane, EnclosedCells& cells) {
    const auto& box = box_of<Dim>(cells);
    Array<double> flow = outflow(body, membrane, grid, cells);
    sum_into_hosts(cells, flow);
    for (std::size_t c = 0; c < box.size(); ++c) {
      const int host = cells.host[c];
      cells.rate[flat_of(grid.layout, box, static_cast<int>(c))] =
          cells.volume[host] > 0 ? flow[host] / cells.volume[host] : 0.0;
    }
    even_out(body, grid.layout, evening * wave_speed(body.material) * dt / grid.layout.h, cells);
  });
}

#define GEODROP_INSTANTIATE(D)                                                           \
  template void update_enclosed_cells(const State<D>&, Grid<D>&);                        \
  template void add_fluid_loads(State<D>&, const Grid<D>&);                              \
  template void enclosed_force_to_grid(const State<D>&, Grid<D>&, const Point&, double); \
  template void update_enclosed_rates(State<D>&, Grid<D>&, double);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
