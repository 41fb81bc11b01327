#include "enclosed_fluid.hpp"

#include <algorithm>
#include <cmath>

#include "cut_cells.hpp"
#include "geometry/polygon.hpp"
#include "grid/blocks.hpp"
#include "grid/nearby_cells.hpp"
#include "membrane/fluid_load.hpp"
#include "membrane/membrane_force.hpp"
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
constexpr double least_inside = 0.5, least_filled = 0.3;

/// A cell that does not stand by itself joins the nearest that does. Local indices.
void choose_hosts(double cell_volume, EnclosedCells& cells) {
  static const std::vector<std::array<int, 2>> nearby = offsets_by_distance();  // a thin tube has no host any nearer
  const int nx = cells.count[0], ny = cells.count[1];
  const auto stands = [&](int c) {
    return cells.area[c] >= least_inside && cells.volume[c] >= least_filled * cell_volume;
  };
  cells.host.resize(cells.area.size());
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int c = i + j * nx;
      cells.host[c] = c;
      for (std::size_t n = 0; n < nearby.size() && !stands(cells.host[c]); ++n) {
        const int x = i + nearby[n][0], y = j + nearby[n][1];
        if (x >= 0 && y >= 0 && x < nx && y < ny && stands(x + y * nx)) cells.host[c] = x + y * nx;
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
template <class F>
void for_each_particle(const Body<2>& body, const GridLayout<2>& layout, const EnclosedCells& cells, F&& f) {
  for (std::size_t p = 0; p < body.size(); ++p)
    if (const int cell = local_cell(layout, cells, body.x[0][p], body.x[1][p]); cell >= 0) f(p, cell);
}

void sum_particles(const Body<2>& body, const GridLayout<2>& layout, EnclosedCells& cells) {
  const auto& fluid = std::get<Newtonian>(body.material);
  cells.volume.assign(cells.area.size(), 0.0);
  cells.pressure.assign(cells.area.size(), 0.0);
  for_each_particle(body, layout, cells, [&](std::size_t p, int c) {
    const double volume = body.volume(p);
    cells.volume[c] += volume;
    cells.pressure[c] += volume * fluid.bulk_modulus * (1 / body.J[p] - 1);
  });
}

/// A face between two cells of different hosts: local cells, flat indices of its six nodes, int N over the part inside
/// [m], and the axis that it is normal to.
struct Face {
  int below, above, axis;
  std::array<int, 6> node;
  std::array<double, 6> weight;
};

template <class F>
void for_each_face(const GridLayout<2>& layout, const EnclosedCells& cells, F&& f) {
  const auto [nx, ny] = cells.count;
  for (int axis = 0; axis < 2; ++axis) {
    const Array<FaceMoments>& faces = axis == 0 ? cells.right_face : cells.top_face;
    const int to_above = axis == 0 ? 1 : nx;
    const int across = layout.stride[axis], along = layout.stride[1 - axis];
    for (int j = 0; j < ny - axis; ++j)
      for (int i = 0; i < nx - 1 + axis; ++i) {
        const int c = i + j * nx;
        if (faces[c][0] <= 0 || cells.host[c] == cells.host[c + to_above]) continue;
        Face face{c, c + to_above, axis, {}, {}};
        const int flat = flat_of(layout, cells, c);
        const std::array<double, 3> integral = face_integrals(faces[c]);
        for (int n = 0; n < 3; ++n)
          for (int side = 0; side < 2; ++side) {
            face.node[2 * n + side] = flat + (n - 1) * along + side * across;
            face.weight[2 * n + side] = 0.5 * layout.h * integral[n];  // N across is 1/2 for both
          }
        f(face);
      }
  }
}

/// Share of the wave speed at which differences of pi even out from cell to cell, and of J within a cell.
constexpr double evening = 0.1;

/// J of particles moves by `share` towards the mean of their cell; the volume of the cell stays.
void even_out(Body<2>& body, const GridLayout<2>& layout, double share, const EnclosedCells& cells) {
  Array<double> rest(cells.area.size(), 0.0);
  for_each_particle(body, layout, cells,
                    [&](std::size_t p, int c) { rest[cells.host[c]] += body.volume(p) / body.J[p]; });
  for_each_particle(body, layout, cells, [&](std::size_t p, int c) {
    const int host = cells.host[c];
    body.J[p] += share * (cells.volume[host] / rest[host] - body.J[p]);
  });
}

/// Flow out of the cells through faces and membrane, of velocities and of evening pressures [m2/s].
Array<double> outflow(const Body<2>& body, const Membrane<2>& membrane, const Grid<2>& grid,
                      const EnclosedCells& cells) {
  const auto& fluid = std::get<Newtonian>(body.material);
  const double conductance = evening * std::sqrt(fluid.bulk_modulus / fluid.density) / fluid.bulk_modulus;
  Array<double> flow(cells.area.size(), 0.0);
  for_each_face(grid.layout, cells, [&](const Face& face) {
    const double jump = cells.pressure[cells.host[face.below]] - cells.pressure[cells.host[face.above]];
    double through = 0;
    for (std::size_t n = 0; n < face.node.size(); ++n)
      through += face.weight[n] * (grid.velocity[face.node[n]][face.axis] + conductance * jump);
    flow[face.below] += through;
    flow[face.above] -= through;
  });
  const auto v = node_velocities(membrane, grid);
  const auto& [x, y] = membrane.x;
  for (const CutCells::Piece& piece : cells.pieces) {
    const std::size_t k = piece.edge, next = end_of_edge(k, membrane.nodes());
    const double normal[] = {cells.sense * (y[next] - y[k]), cells.sense * (x[k] - x[next])};
    const double of_end = 0.5 * (piece.to * piece.to - piece.from * piece.from),
                 of_start = piece.to - piece.from - of_end;
    for (int a = 0; a < 2; ++a) flow[piece.cell] += normal[a] * (of_start * v[a][k] + of_end * v[a][next]);
  }
  return flow;
}

/// Adds m `lift` of the enclosed fluids to the nodes.
void take_gravity(const State<2>& state, const Grid<2>& grid, const std::array<double, 2>& lift, Array<Vec4>& target) {
  const auto is_enclosed = [](const Body<2>& body) { return body.pressure == PressureSupport::enclosed; };
  const auto other = [&](const Body<2>& body) { return body.field == grid.field && !is_enclosed(body); };
  if (std::none_of(state.bodies.begin(), state.bodies.end(), other)) {
    // So far all mass on the nodes is theirs, which spares a third of a step of summing it up again.
    for_each_active_row(grid, [&](int begin, int count, const auto&) {
      for (int node = begin; node < begin + count; ++node)
        for (int a = 0; a < 2; ++a) target[node][a] += lift[a] * grid.sum[node][3];
    });
    return;
  }
  std::array<Array<double>, 2> lifts;
  const std::size_t n = state.particles();
  for (int a = 0; a < 2; ++a) lifts[a].assign(n, lift[a]);
  for_each_slab_by_colour(state, grid, [&](const Body<2>& body, std::size_t begin, std::size_t end) {
    if (is_enclosed(body)) sum_by_mass<2>(body, {pointers(lifts), 0.0}, grid.layout, target.data(), begin, end);
  });
}

}  // namespace

void update_enclosed_cells(const State<2>& state, Grid<2>& grid) {
  for_each_enclosed(state, grid, [&](const Body<2>& body, const Membrane<2>& membrane, EnclosedCells& cells) {
    cut_cells(grid.layout, membrane.x[0], membrane.x[1], cells);
    sum_particles(body, grid.layout, cells);
    choose_hosts(grid.layout.h * grid.layout.h, cells);
    sum_into_hosts(cells, cells.volume);
    sum_into_hosts(cells, cells.pressure);
    for (std::size_t c = 0; c < cells.volume.size(); ++c)
      if (cells.volume[c] > 0) cells.pressure[c] /= cells.volume[c];
  });
}

void add_fluid_loads(State<2>& state, const Grid<2>& grid) {
  for_each_enclosed(state, grid, [&](const Body<2>& body, Membrane<2>& membrane, const EnclosedCells& cells) {
    for (const CutCells::Piece& piece : cells.pieces) {
      const double pressure = cells.pressure[cells.host[piece.cell]];
      add_pressure({piece.from, piece.to, pressure, pressure}, cells.sense, piece.edge, membrane);
    }
    const Array<double>& y = membrane.x[1];
    const auto weight = [&](std::size_t k) { return body.unit_weight * (body.weightless_level - y[k]); };
    for (std::size_t k = 0; k < membrane.nodes(); ++k)
      add_pressure({0, 1, weight(k), weight(end_of_edge(k, membrane.nodes()))}, cells.sense, k, membrane);
  });
}

void enclosed_force_to_grid(const State<2>& state, Grid<2>& grid, const Point& g, double dt) {
  const bool separate = !grid.force.empty();
  Array<Vec4>& target = separate ? grid.force : grid.sum;
  const double scale = separate ? 1.0 : dt;
  for_each_enclosed(state, grid, [&](const Body<2>&, const Membrane<2>&, const EnclosedCells& cells) {
    for_each_face(grid.layout, cells, [&](const Face& face) {
      const double jump = cells.pressure[cells.host[face.below]] - cells.pressure[cells.host[face.above]];
      for (std::size_t n = 0; n < face.node.size(); ++n)
        target[face.node[n]][face.axis] += scale * jump * face.weight[n];
    });
  });
  take_gravity(state, grid, {-scale * g[0], -scale * g[1]}, target);
}

void update_enclosed_rates(State<2>& state, Grid<2>& grid, double dt) {
  for_each_enclosed(state, grid, [&](Body<2>& body, const Membrane<2>& membrane, EnclosedCells& cells) {
    Array<double> flow = outflow(body, membrane, grid, cells);
    sum_into_hosts(cells, flow);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const int host = cells.host[c];
      cells.rate[flat_of(grid.layout, cells, static_cast<int>(c))] =
          cells.volume[host] > 0 ? flow[host] / cells.volume[host] : 0.0;
    }
    even_out(body, grid.layout, evening * wave_speed(body.material) * dt / grid.layout.h, cells);
  });
}

}  // namespace geodrop
