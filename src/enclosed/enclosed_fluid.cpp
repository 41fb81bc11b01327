#include "enclosed_fluid.hpp"

#include <algorithm>
#include <cmath>

#include "../kernels/kernels.hpp"
#include "../kernels/slabs.hpp"
#include "polygon_moments.hpp"

namespace geodrop {
namespace {

/// f(body, its membrane, its cells) for all enclosed bodies.
template <class State, class Cells, class F>
void for_each_enclosed(State& state, Cells& enclosed, F&& f) {
  for (auto& body : state.bodies) {
    if (body.pressure != PressureSupport::enclosed) continue;
    const auto membrane = std::find_if(state.membranes.begin(), state.membranes.end(),
                                       [&](const auto& m) { return m.closed && m.body == body.name; });
    f(body, *membrane, enclosed[body.enclosed]);
  }
}

/// A cell keeps a pressure of its own if this share of it lies inside and is filled.
constexpr double least_inside = 0.5, least_filled = 0.3;

/// Offsets to the cells around, nearest first; a tube thinner than a cell has no cell nearby that stands by itself.
/// The order is fixed: the largest of several whole cells would be another one at each step, by round-off, and the
/// changing hosts would keep a tube in motion (6.45 m2: a tenth of its weight out of balance for ever).
std::vector<std::array<int, 2>> offsets_by_distance() {
  constexpr int farthest = 3;
  std::vector<std::array<int, 2>> offsets;
  for (int y = -farthest; y <= farthest; ++y)
    for (int x = -farthest; x <= farthest; ++x) offsets.push_back({x, y});
  const auto square = [](const std::array<int, 2>& o) { return o[0] * o[0] + o[1] * o[1]; };
  std::stable_sort(offsets.begin(), offsets.end(), [&](const auto& a, const auto& b) { return square(a) < square(b); });
  return offsets;
}

/// A cell that does not stand by itself joins the nearest that does. Local indices.
void choose_hosts(double cell_volume, EnclosedCells& cells) {
  const int nx = cells.count[0], ny = cells.count[1];
  const auto stands = [&](int c) {
    return cells.moments[c][0] >= least_inside && cells.volume[c] >= least_filled * cell_volume;
  };
  static const std::vector<std::array<int, 2>> nearby = offsets_by_distance();
  cells.host.resize(cells.moments.size());
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

/// Local index of the cell of a particle, -1 outside of the box.
int local_cell(const GridLayout<2>& layout, const EnclosedCells& cells, double x, double y) {
  const int i = layout.base(0, x) + GridLayout<2>::pad - cells.first[0];
  const int j = layout.base(1, y) + GridLayout<2>::pad - cells.first[1];
  const bool inside = i >= 0 && j >= 0 && i < cells.count[0] && j < cells.count[1];
  return inside ? i + j * cells.count[0] : -1;
}

/// Share of the wave speed at which differences of pi even out from cell to cell, and of J within a cell.
constexpr double evening = 0.1;

/// Volume that cells of higher pressure hand to their neighbours [m2/s].
void add_diffusion(const Newtonian& fluid, double h, const EnclosedCells& cells, Array<double>& flux) {
  const double conductance = evening * std::sqrt(fluid.bulk_modulus / fluid.density) * h / fluid.bulk_modulus;
  const int nx = cells.count[0], ny = cells.count[1];
  const auto exchange = [&](int c, int neighbour) {
    const int a = cells.host[c], b = cells.host[neighbour];
    if (cells.moments[c][0] <= 0 || cells.moments[neighbour][0] <= 0) return;
    const double q = conductance * (cells.pressure[a] - cells.pressure[b]);
    flux[a] += q;
    flux[b] -= q;
  };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      if (i + 1 < nx) exchange(i + j * nx, i + 1 + j * nx);
      if (j + 1 < ny) exchange(i + j * nx, i + (j + 1) * nx);
    }
}

void sum_particles(const Body<2>& body, const GridLayout<2>& layout, EnclosedCells& cells) {
  const auto& fluid = std::get<Newtonian>(body.material);
  cells.volume.assign(cells.moments.size(), 0.0);
  cells.pressure.assign(cells.moments.size(), 0.0);
  for (std::size_t p = 0; p < body.size(); ++p) {
    const int c = local_cell(layout, cells, body.x[0][p], body.x[1][p]);
    if (c < 0) continue;
    const double volume = body.volume(p);
    cells.volume[c] += volume;
    cells.pressure[c] += volume * fluid.bulk_modulus * (1 / body.J[p] - 1);
  }
}

/// J of particles moves by `share` towards the mean of their cell; the volume of the cell stays.
void even_out(Body<2>& body, const GridLayout<2>& layout, double share, const EnclosedCells& cells) {
  Array<double> rest(cells.moments.size(), 0.0);
  for (std::size_t p = 0; p < body.size(); ++p)
    if (const int c = local_cell(layout, cells, body.x[0][p], body.x[1][p]); c >= 0)
      rest[cells.host[c]] += body.volume(p) / body.J[p];
  for (std::size_t p = 0; p < body.size(); ++p)
    if (const int c = local_cell(layout, cells, body.x[0][p], body.x[1][p]); c >= 0)
      body.J[p] += share * (cells.volume[cells.host[c]] / rest[cells.host[c]] - body.J[p]);
}

/// f(local cell, flat index, gradients) for all cells that are at least partly inside.
template <class F>
void for_each_cell(const GridLayout<2>& layout, const EnclosedCells& cells, F&& f) {
  constexpr double nothing = 1e-12;
  for (int j = 0; j < cells.count[1]; ++j)
    for (int i = 0; i < cells.count[0]; ++i) {
      const int c = i + j * cells.count[0];
      if (cells.moments[c][0] < nothing) continue;
      f(c, cells.first[0] + i + (cells.first[1] + j) * layout.stride[1],
        gradient_integrals(cells.moments[c], layout.h));
    }
}

}  // namespace

template <>
void update_enclosed_cells(const State<2>& state, Grid<2>& grid) {
  for_each_enclosed(state, grid.enclosed, [&](const Body<2>& body, const Membrane<2>& membrane, EnclosedCells& cells) {
    cover_polygon(grid.layout, membrane.x[0], membrane.x[1], cells);
    sum_particles(body, grid.layout, cells);
    choose_hosts(grid.layout.h * grid.layout.h, cells);
    sum_into_hosts(cells, cells.volume);
    sum_into_hosts(cells, cells.pressure);
    for (std::size_t c = 0; c < cells.volume.size(); ++c)
      if (cells.volume[c] > 0) cells.pressure[c] /= cells.volume[c];
  });
}

template <>
void add_weight_loads(State<2>& state) {
  std::vector<EnclosedCells> none(state.bodies.size());
  for_each_enclosed(state, none, [&](const Body<2>& body, Membrane<2>& membrane, const EnclosedCells&) {
    const auto& [x, y] = membrane.x;
    double twice_area = 0;
    for (std::size_t k = 0; k < membrane.nodes(); ++k) {
      const std::size_t next = k + 1 == membrane.nodes() ? 0 : k + 1;
      twice_area += x[k] * y[next] - x[next] * y[k];
    }
    const double outward = twice_area > 0 ? 1 : -1;
    for (std::size_t k = 0; k < membrane.nodes(); ++k) {
      const std::size_t next = k + 1 == membrane.nodes() ? 0 : k + 1;
      const double here = outward * body.unit_weight * (body.weightless_level - y[k]);
      const double there = outward * body.unit_weight * (body.weightless_level - y[next]);
      const double normal[] = {y[next] - y[k], x[k] - x[next]};
      for (int a = 0; a < 2; ++a) {
        membrane.load[a][k] += (here / 3 + there / 6) * normal[a];
        membrane.load[a][next] += (here / 6 + there / 3) * normal[a];
      }
    }
  });
}

template <>
void enclosed_force_to_grid(const State<2>& state, Grid<2>& grid, const Point& g, double dt) {
  const bool separate = !grid.force.empty();
  Array<Vec4>& target = separate ? grid.force : grid.sum;
  const double scale = separate ? 1.0 : dt;
  for_each_enclosed(state, grid.enclosed, [&](const Body<2>& body, const Membrane<2>&, const EnclosedCells& cells) {
    for_each_cell(grid.layout, cells, [&](int c, int flat, const CellGradients& gradients) {
      const double pressure = scale * cells.pressure[cells.host[c]];
      for (int n = 0; n < 9; ++n) {
        Vec4& record = target[flat + n % 3 - 1 + (n / 3 - 1) * grid.layout.stride[1]];
        for (int a = 0; a < 2; ++a) record[a] += pressure * gradients[n][a];
      }
    });
    std::array<Array<double>, 2> lift;
    for (int a = 0; a < 2; ++a) lift[a].assign(body.size(), -scale * g[a]);
    for_each_slab_by_colour(state, grid.layout, [&](const Body<2>& other, std::size_t begin, std::size_t end) {
      if (&other == &body) sum_by_mass<2>(body, {pointers(lift), 0.0}, grid.layout, target.data(), begin, end);
    });
  });
}

template <>
void update_enclosed_rates(State<2>& state, Grid<2>& grid, double dt) {
  for_each_enclosed(state, grid.enclosed, [&](Body<2>& body, const Membrane<2>&, EnclosedCells& cells) {
    const auto& fluid = std::get<Newtonian>(body.material);
    Array<double> flux(cells.moments.size(), 0.0);
    for_each_cell(grid.layout, cells, [&](int c, int flat, const CellGradients& gradients) {
      for (int n = 0; n < 9; ++n) {
        const Vec4& v = grid.velocity[flat + n % 3 - 1 + (n / 3 - 1) * grid.layout.stride[1]];
        flux[c] += v[0] * gradients[n][0] + v[1] * gradients[n][1];
      }
    });
    sum_into_hosts(cells, flux);
    add_diffusion(fluid, grid.layout.h, cells, flux);
    even_out(body, grid.layout, evening * std::sqrt(fluid.bulk_modulus / fluid.density) * dt / grid.layout.h, cells);
    for (int j = 0; j < cells.count[1]; ++j)
      for (int i = 0; i < cells.count[0]; ++i) {
        const int host = cells.host[i + j * cells.count[0]];
        cells.rate[cells.first[0] + i + (cells.first[1] + j) * grid.layout.stride[1]] =
            cells.volume[host] > 0 ? flux[host] / cells.volume[host] : 0.0;
      }
  });
}

// Enclosed fluids are for the plane: check_scene refuses them in space.
template <>
void update_enclosed_cells(const State<3>&, Grid<3>&) {}
template <>
void add_weight_loads(State<3>&) {}
template <>
void enclosed_force_to_grid(const State<3>&, Grid<3>&, const Point&, double) {}
template <>
void update_enclosed_rates(State<3>&, Grid<3>&, double) {}

}  // namespace geodrop
