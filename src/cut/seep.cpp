#include "seep.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "cells_around.hpp"
#include "clipped_cells.hpp"
#include "cut_cells.hpp"
#include "membrane/part_size.hpp"
#include "stretches.hpp"
#include "wet_cells.hpp"

namespace geodrop {
namespace {

/// Of the particles that share one pressure.
template <int Dim>
struct Pool {
  double mass = 0, volume = 0;            ///< [kg], [m3]
  std::array<double, Dim> momentum{};     ///< [kg m/s]
  double given = 0, taken = 0;            ///< mass [kg]
  std::array<double, Dim> taken_speed{};  ///< momentum that came with it [kg m/s]
};

/// The cells of a field that share a pressure, by their host, and what their particles hold.
template <int Dim>
class Pools {
 public:
  Pools(const Grid<Dim>& grid, Body<Dim>& body) : grid_(grid), body_(body) {
    for (const PartCell<Dim>& part : grid.part_cells)
      if (part.host >= 0) host_.emplace_back(part.flat, part.host);
    if (host_.empty()) return;
    std::sort(host_.begin(), host_.end());
    find_members();
    for (const auto& [p, of_cell] : members_) {
      Pool<Dim>& pool = *of_cell;
      pool.mass += body.mass[p];
      pool.volume += body.volume(p);
      for (int a = 0; a < Dim; ++a) pool.momentum[a] += body.mass[p] * body.v[a][p];
    }
  }

  /// That of a cell; null if nothing is in it.
  Pool<Dim>* of(int flat) {
    const int host = host_of(flat);
    const auto found = pools_.find(host);
    return host >= 0 && found != pools_.end() && found->second.mass > 0 ? &found->second : nullptr;
  }

  /// Particles give a share of their mass each, with its gas, and take a share of what comes by theirs, water alone.
  void hand_over() {
    for (const auto& [p, of_cell] : members_) {
      const Pool<Dim>& pool = *of_cell;
      const double kept = body_.mass[p] * (1 - pool.given / pool.mass), part = body_.mass[p] / pool.mass;
      const double mass = kept + part * pool.taken;
      for (int a = 0; a < Dim; ++a) body_.v[a][p] = (kept * body_.v[a][p] + part * pool.taken_speed[a]) / mass;
      if (const double gas = body_.gas_at(p); gas > 0) thin_out(gas * kept / mass, p);
      body_.mass[p] = mass;
    }
  }

 private:
  /// Less gas per water, at the same pressure.
  void thin_out(double gas, std::size_t p) {
    const auto& fluid = std::get<Newtonian>(body_.material);
    body_.J[p] = fluid_volume_ratio(fluid, fluid_pressure(fluid, body_.J[p], body_.gas[p]), gas);
    body_.gas[p] = gas;
  }

  int host_of(int flat) const {
    const auto place = std::lower_bound(host_.begin(), host_.end(), std::pair(flat, -1));
    return place != host_.end() && place->first == flat ? place->second : -1;
  }

  BoxOfCells<Dim> box_of_parts() const {
    std::array<int, Dim> first = stored_cell(grid_.layout, host_.front().first), last = first;
    for (const auto& [flat, host] : host_)
      for (int a = 0; a < Dim; ++a) {
        first[a] = std::min(first[a], stored_cell(grid_.layout, flat)[a]);
        last[a] = std::max(last[a], stored_cell(grid_.layout, flat)[a]);
      }
    return {grid_.layout, first, last};
  }

  /// Particles of a cell stand together for the most part.
  void find_members() {
    const BoxOfCells<Dim> box = box_of_parts();
    int last = -1;
    Pool<Dim>* pool = nullptr;
    for (std::size_t p = 0; p < body_.size(); ++p) {
      if (!box.may_hold(body_.x, p)) continue;
      const int flat = cell_at(grid_.layout, body_.x, p);
      if (flat != last) {
        const int host = host_of(last = flat);
        pool = host >= 0 ? &pools_[host] : nullptr;
      }
      if (pool) members_.emplace_back(p, pool);
    }
  }

  const Grid<Dim>& grid_;
  Body<Dim>& body_;
  std::vector<std::pair<int, int>> host_;                    ///< of each part, by flat index
  std::vector<std::pair<std::size_t, Pool<Dim>*>> members_;  ///< particles with the pools of their hosts
  std::map<int, Pool<Dim>> pools_;                           ///< by host
};

/// Volume that flows outwards through each cell in a step [m3].
template <int Dim>
std::map<int, double> flows(const GridLayout<Dim>& layout, const Membrane<Dim>& membrane, const Outline<Dim>& cells,
                            double dt) {
  std::map<int, double> out;
  for (const auto& piece : cells.pieces) {
    const auto [part, share] = share_of(piece);
    out[flat_of(layout, cells, piece.cell)] += dt * membrane.seepage[part] * share * size_of(membrane, part);
  }
  return out;
}

/// Takes what flows out of a pool; the mass [kg].
template <int Dim>
double let_out(Pool<Dim>& from, double volume) {
  constexpr double most = 0.5;  // of what is left
  const double mass = std::min(volume * from.mass / from.volume, most * (from.mass - from.given));
  from.given += mass;
  return mass;
}

template <int Dim>
void give(Pool<Dim>& from, Pool<Dim>& to, double volume) {
  const double mass = let_out(from, volume);
  to.taken += mass;
  for (int a = 0; a < Dim; ++a) to.taken_speed[a] += mass * from.momentum[a] / from.mass;
}

template <int Dim>
Body<Dim>* fluid_of(State<Dim>& state, int field) {
  const auto found = std::find_if(state.bodies.begin(), state.bodies.end(), [&](const Body<Dim>& body) {
    return body.field == field && std::holds_alternative<Newtonian>(body.material);
  });
  return found == state.bodies.end() ? nullptr : &*found;
}

}  // namespace

template <int Dim>
void seep(State<Dim>& state, const Grids<Dim>& grids, double dt) {
  for (const Membrane<Dim>& membrane : state.membranes) {
    if (!acts_sharply(membrane) || membrane.permeance == 0) continue;
    const Grid<Dim>& grid = grids[membrane.field];
    Body<Dim>*const water = fluid_of(state, grid.pore_water), *const around = fluid_of(state, 0);
    if (!water) continue;
    Pools<Dim> inside(grids[grid.pore_water], *water);
    std::optional<Pools<Dim>> outside;
    if (around) outside.emplace(grids.front(), *around);
    for (const auto& [flat, volume] : flows(grid.layout, membrane, grid.outline, dt)) {
      Pool<Dim>* const in = inside.of(flat);
      Pool<Dim>* const out = outside ? outside->of(flat) : nullptr;
      if (!in) continue;
      if (out && volume > 0)
        give(*in, *out, volume);
      else if (out)
        give(*out, *in, -volume);
      else if (volume > 0 && !is_wet(grids.front(), flat))
        let_out(*in, volume);
    }
    inside.hand_over();
    if (outside) outside->hand_over();
  }
}

template void seep(State<2>&, const Grids<2>&, double);
template void seep(State<3>&, const Grids<3>&, double);

}  // namespace geodrop
