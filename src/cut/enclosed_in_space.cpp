#include "enclosed_in_space.hpp"

#include <algorithm>
#include <cmath>

#include "clipped_cells.hpp"
#include "grid/blocks.hpp"
#include "membrane/membrane_force.hpp"
#include "membrane/surface_load.hpp"
#include "membrane/triangles.hpp"

namespace geodrop {
namespace {

/// f(body, its membrane, its cells) for all enclosed bodies of a velocity field.
template <class State, class Grid, class F>
void for_each_enclosed(State& state, Grid& grid, F&& f) {
  for (auto& body : state.bodies) {
    if (body.field != grid.field || body.pressure != PressureSupport::enclosed) continue;
    const auto membrane = std::find_if(state.membranes.begin(), state.membranes.end(),
                                       [&](const auto& m) { return m.body == body.name; });
    f(body, *membrane, grid.enclosed[static_cast<std::size_t>(body.enclosed)]);
  }
}

/// A cell stands by itself if this share of it lies inside and is filled.
constexpr double least_inside = 0.5, least_filled = 0.3;

/// Offsets to the cells around, up to two away, nearest first, in a fixed order as in nearby_cells.
const std::vector<std::array<int, 3>>& nearby_offsets() {
  static const std::vector<std::array<int, 3>> offsets = [] {
    constexpr int farthest = 2;
    std::vector<std::array<int, 3>> all;
    for (int z = -farthest; z <= farthest; ++z)
      for (int y = -farthest; y <= farthest; ++y)
        for (int x = -farthest; x <= farthest; ++x) all.push_back({x, y, z});
    const auto square = [](const std::array<int, 3>& o) { return o[0] * o[0] + o[1] * o[1] + o[2] * o[2]; };
    std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return square(a) < square(b); });
    return all;
  }();
  return offsets;
}

/// A cell that does not stand by itself joins the nearest that does. Local indices.
void choose_hosts(double cell_volume, EnclosedCells& cells) {
  const std::array<int, 3>& count = cells.space.count;
  const auto stands = [&](int c) {
    return cells.space.inside[c] >= least_inside && cells.volume[c] >= least_filled * cell_volume;
  };
  const int n = static_cast<int>(cells.space.size());
  cells.host.resize(cells.space.size());
  for (int c = 0; c < n; ++c) {
    cells.host[c] = c;
    if (stands(c)) continue;
    const std::array<int, 3> at{c % count[0], c / count[0] % count[1], c / (count[0] * count[1])};
    for (const std::array<int, 3>& offset : nearby_offsets()) {
      std::array<int, 3> other;
      bool in_box = true;
      for (std::size_t a = 0; a < 3; ++a) {
        other[a] = at[a] + offset[a];
        in_box = in_box && other[a] >= 0 && other[a] < count[a];
      }
      const int neighbour = other[0] + count[0] * (other[1] + count[1] * other[2]);
      if (!in_box || !stands(neighbour)) continue;
      cells.host[c] = neighbour;
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
template <class F>
void for_each_particle(const Body<3>& body, const GridLayout<3>& layout, const EnclosedCells& cells, F&& f) {
  for (std::size_t p = 0; p < body.size(); ++p)
    if (const int cell = local_cell(layout, cells.space, vector_at(body.x, p)); cell >= 0) f(p, cell);
}

void sum_particles(const Body<3>& body, const GridLayout<3>& layout, EnclosedCells& cells) {
  const auto& fluid = std::get<Newtonian>(body.material);
  cells.volume.assign(cells.space.size(), 0.0);
  cells.pressure.assign(cells.space.size(), 0.0);
  for_each_particle(body, layout, cells, [&](std::size_t p, int c) {
    const double volume = body.volume(p);
    cells.volume[c] += volume;
    cells.pressure[c] += volume * fluid.bulk_modulus * (1 / body.J[p] - 1);
  });
}

/// A face between two cells of different hosts: local cells, the nodes below it along its axis (3 x 3; those above are
/// `across` further on), int N over the part inside for either [m2].
struct Face {
  int below, above, axis, across;
  std::array<int, 9> node;
  std::array<double, 9> weight;
};

template <class F>
void for_each_face(const GridLayout<3>& layout, const EnclosedCells& cells, F&& f) {
  const ClippedCells& space = cells.space;
  const std::array<int, 3> local{1, space.count[0], space.count[0] * space.count[1]};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    for (int c = 0; c < static_cast<int>(space.size()); ++c) {
      const ClippedCells::FaceMoments& moments = space.upper_face[axis][c];
      if (!(moments[0] > 0) || cells.host[c] == cells.host[c + local[axis]]) continue;
      Face face{c, c + local[axis], axis, layout.stride[axis], {}, face_integrals(moments)};
      const int flat = flat_of(layout, space, c);
      for (int n = 0; n < 9; ++n) {
        face.node[n] = flat + (n % 3 - 1) * layout.stride[u] + (n / 3 - 1) * layout.stride[w];
        face.weight[n] *= 0.5 * layout.h * layout.h;  // N across is 1/2 for both
      }
      f(face);
    }
  }
}

/// Share of the wave speed at which differences of pi even out from cell to cell, and of J within a cell.
constexpr double evening = 0.1;

/// J of particles moves by `share` towards the mean of their cell; the volume of the cell stays.
void even_out(Body<3>& body, const GridLayout<3>& layout, double share, const EnclosedCells& cells) {
  Array<double> rest(cells.space.size(), 0.0);
  for_each_particle(body, layout, cells,
                    [&](std::size_t p, int c) { rest[cells.host[c]] += body.volume(p) / body.J[p]; });
  for_each_particle(body, layout, cells, [&](std::size_t p, int c) {
    const int host = cells.host[c];
    body.J[p] += share * (cells.volume[host] / rest[host] - body.J[p]);
  });
}

/// Area times outward unit normal of each triangle [m2].
Vec<3> area_vector(const Membrane<3>& membrane, std::size_t triangle) { return 0.5 * normal_of(membrane, triangle); }

/// Flow out of the cells through faces and membrane, of velocities and of evening pressures [m3/s].
Array<double> outflow(const Body<3>& body, const Membrane<3>& membrane, const Grid<3>& grid,
                      const EnclosedCells& cells) {
  const auto& fluid = std::get<Newtonian>(body.material);
  const double conductance = evening * std::sqrt(fluid.bulk_modulus / fluid.density) / fluid.bulk_modulus;
  Array<double> flow(cells.space.size(), 0.0);
  for_each_face(grid.layout, cells, [&](const Face& face) {
    const double jump = cells.pressure[cells.host[face.below]] - cells.pressure[cells.host[face.above]];
    double through = 0;
    for (std::size_t n = 0; n < face.node.size(); ++n)
      for (const int node : {face.node[n], face.node[n] + face.across})
        through += face.weight[n] * (grid.velocity[node][face.axis] + conductance * jump);
    flow[face.below] += through;
    flow[face.above] -= through;
  });
  const auto v = node_velocities(membrane, grid);
  for (const ClippedCells::Piece& piece : cells.space.pieces) {
    const Vec<3> area = area_vector(membrane, piece.triangle);
    for (std::size_t k = 0; k < 3; ++k)
      flow[piece.cell] += piece.share[k] * area.dot(vector_at(v, membrane.triangles.corner[k][piece.triangle]));
  }
  return flow;
}

}  // namespace

void update_enclosed_cells(const State<3>& state, Grid<3>& grid) {
  for_each_enclosed(state, grid, [&](const Body<3>& body, const Membrane<3>& membrane, EnclosedCells& cells) {
    clip_cells(grid.layout, membrane, cells.space);
    sum_particles(body, grid.layout, cells);
    choose_hosts(std::pow(grid.layout.h, 3), cells);
    sum_into_hosts(cells, cells.volume);
    sum_into_hosts(cells, cells.pressure);
    for (std::size_t c = 0; c < cells.volume.size(); ++c)
      if (cells.volume[c] > 0) cells.pressure[c] /= cells.volume[c];
  });
}

void add_fluid_loads(State<3>& state, const Grid<3>& grid) {
  for_each_enclosed(state, grid, [&](const Body<3>& body, Membrane<3>& membrane, const EnclosedCells& cells) {
    for (const ClippedCells::Piece& piece : cells.space.pieces) {
      const Vec<3> push = cells.pressure[cells.host[piece.cell]] * area_vector(membrane, piece.triangle);
      for (std::size_t k = 0; k < 3; ++k)
        for (int a = 0; a < 3; ++a)
          membrane.load[a][membrane.triangles.corner[k][piece.triangle]] += piece.share[k] * push[a];
    }
    add_weight(body.unit_weight, body.weightless_level, membrane);
  });
}

void enclosed_force_to_grid(const State<3>& state, Grid<3>& grid, const Point& g, double dt) {
  const bool separate = !grid.force.empty();
  Array<Vec4>& target = separate ? grid.force : grid.sum;
  const double scale = separate ? 1.0 : dt;
  for_each_enclosed(state, grid, [&](const Body<3>&, const Membrane<3>&, const EnclosedCells& cells) {
    for_each_face(grid.layout, cells, [&](const Face& face) {
      const double jump = cells.pressure[cells.host[face.below]] - cells.pressure[cells.host[face.above]];
      for (std::size_t n = 0; n < face.node.size(); ++n)
        for (const int node : {face.node[n], face.node[n] + face.across})
          target[node][face.axis] += scale * jump * face.weight[n];
    });
  });
  // So far all mass on the nodes is that of enclosed fluids.
  for_each_active_row(grid, [&](int begin, int count, const auto&) {
    for (int node = begin; node < begin + count; ++node)
      for (int a = 0; a < 3; ++a) target[node][a] -= scale * g[a] * grid.sum[node][3];
  });
}

void update_enclosed_rates(State<3>& state, Grid<3>& grid, double dt) {
  for_each_enclosed(state, grid, [&](Body<3>& body, const Membrane<3>& membrane, EnclosedCells& cells) {
    Array<double> flow = outflow(body, membrane, grid, cells);
    sum_into_hosts(cells, flow);
    for (std::size_t c = 0; c < cells.space.size(); ++c) {
      const int host = cells.host[c];
      cells.rate[flat_of(grid.layout, cells.space, static_cast<int>(c))] =
          cells.volume[host] > 0 ? flow[host] / cells.volume[host] : 0.0;
    }
    even_out(body, grid.layout, evening * wave_speed(body.material) * dt / grid.layout.h, cells);
  });
}

}  // namespace geodrop
