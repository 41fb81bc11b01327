#include "interface_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cells_around.hpp"
#include "grid/momentum.hpp"

namespace geodrop {

template <int Dim>
Places<Dim>::Places(const Grids<Dim>& grids) : grids_(grids), first_(std::numeric_limits<int>::max()) {
  constexpr int reach = 2;  // beyond the boxes of the outlines
  int last = -1;
  for (const Grid<Dim>& grid : grids) {
    if (grid.outline.size() == 0) continue;
    int lowest = 0, highest = 0;
    for (int a = 0; a < Dim; ++a) {
      lowest += (grid.outline.first[a] - reach) * grid.layout.stride[a];
      highest += (grid.outline.first[a] + grid.outline.count[a] + reach) * grid.layout.stride[a];
    }
    first_ = std::min(first_, lowest);
    last = std::max(last, highest);
  }
  number_.assign(grids.size(), std::vector<int>(last < first_ ? 0 : last - first_ + 1, -1));
}

template <int Dim>
int Places<Dim>::of(int field, int node) {
  int& number = number_[field][node - first_];
  if (number >= 0) return number;
  number = static_cast<int>(list_.size());
  list_.push_back({field, node, std::sqrt(grids_[field].sum[node][3]), held_by_walls(grids_[field].layout, node)});
  return number;
}

namespace {

/// A row's part in one field.
template <int Dim>
class RowInField {
 public:
  RowInField(const Grid<Dim>& grid, double sign, const std::vector<NodeVector<Dim>>& vectors)
      : grid_(grid), sign_(sign) {
    first_.fill(std::numeric_limits<int>::max());
    std::array<int, Dim> last{};
    for (const NodeVector<Dim>& vector : vectors) {
      const std::array<int, Dim> at = stored_cell(grid.layout, vector.node);
      for (int a = 0; a < Dim; ++a) {
        first_[a] = std::min(first_[a], at[a] - 1);
        last[a] = std::max(last[a], at[a] + 1);
      }
    }
    std::size_t size = vectors.empty() ? 0 : 1;
    for (int a = 0; a < Dim && size > 0; ++a) size *= count_[a] = last[a] + 1 - first_[a];
    slot_.assign(size, -1);
    ways_.resize(size);
    entries_.reserve(size);
    root_mass_.reserve(size);
    shares_.reserve(size);
  }

  /// False if nothing there can take it.
  bool add(const std::vector<NodeVector<Dim>>& vectors) {
    std::array<double, Dim> nowhere{};  // vectors with no mass around
    for (const NodeVector<Dim>& vector : vectors) {
      Ways& ways = ways_[place_of(vector.node)];
      if (ways.first < 0) ways = find_ways(vector.node);
      std::array<double, Dim> value;
      for (int a = 0; a < Dim; ++a) value[a] = sign_ * vector.value[a];
      for (int k = ways.first; k < ways.end; ++k)
        for (int a = 0; a < Dim; ++a) entries_[shares_[k].slot].value[a] += shares_[k].scale * value[a];
      if (ways.leads_nowhere)
        for (int a = 0; a < Dim; ++a) nowhere[a] += value[a];
    }
    if (entries_.empty()) return false;
    if (std::any_of(nowhere.begin(), nowhere.end(), [](double v) { return v != 0; })) spread_over_row(nowhere);
    return true;
  }

  const std::vector<typename RawRow<Dim>::Entry>& entries() const { return entries_; }

 private:
  /// What an entry takes of a vector at a node: share / m^1/2.
  struct Share {
    int slot;
    double scale;
  };
  /// Where a vector at a node goes, the same for all pieces of a stretch: [first, end) of shares_.
  struct Ways {
    int first = -1, end = -1;  ///< -1: not known yet
    bool leads_nowhere = false;
  };

  int place_of(int node) const {
    const std::array<int, Dim> at = stored_cell(grid_.layout, node);
    int place = 0;
    for (int a = Dim - 1; a >= 0; --a) place = place * count_[a] + at[a] - first_[a];
    return place;
  }

  Ways find_ways(int node) {
    Ways ways{static_cast<int>(shares_.size())};
    ways.leads_nowhere = !for_shares_of_impulse<Dim>(grid_, node, [&](int to, double share) { put(to, share); });
    ways.end = static_cast<int>(shares_.size());
    return ways;
  }

  /// Nothing if walls hold the node.
  void put(int node, double share) {
    int& slot = slot_[place_of(node)];
    if (slot < 0) {
      const std::array<bool, Dim> fixed = held_by_walls(grid_.layout, node);
      if (std::find(fixed.begin(), fixed.end(), false) == fixed.end()) return;
      slot = static_cast<int>(entries_.size());
      entries_.push_back({grid_.field, node, {}});
      root_mass_.push_back(std::sqrt(grid_.sum[node][3]));
    }
    shares_.push_back({slot, share / root_mass_[slot]});
  }

  /// Hands the rest to the nodes that the row reaches in this field already, by their mass.
  void spread_over_row(const std::array<double, Dim>& value) {
    double mass = 0;
    for (const auto& entry : entries_) mass += grid_.sum[entry.node][3];
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      const double scale = grid_.sum[entries_[k].node][3] / mass / root_mass_[k];
      for (int a = 0; a < Dim; ++a) entries_[k].value[a] += scale * value[a];
    }
  }

  const Grid<Dim>& grid_;
  double sign_;
  std::array<int, Dim> first_{}, count_{};  ///< box of the nodes that it may reach
  std::vector<int> slot_;                   ///< by node of the box: number of its entry
  std::vector<Ways> ways_;                  ///< by node of the box
  std::vector<Share> shares_;
  std::vector<typename RawRow<Dim>::Entry> entries_;
  std::vector<double> root_mass_;
};

}  // namespace

template <int Dim>
RawRow<Dim> make_row(const Grids<Dim>& grids, std::initializer_list<TermOfRow<Dim>> terms) {
  RawRow<Dim> row;
  for (const auto& [field, sign, vectors] : terms) {
    RowInField<Dim> part(grids[field], sign, vectors);
    row.complete = part.add(vectors);
    if (!row.complete) break;
    row.entries.insert(row.entries.end(), part.entries().begin(), part.entries().end());
  }
  return row;
}

template <int Dim>
RawRow<Dim> make_row(const Grids<Dim>& grids, int field, int other, const std::vector<NodeVector<Dim>>& vectors) {
  return make_row<Dim>(grids, {{field, 1, vectors}, {other, -1, vectors}});
}

template <int Dim>
RawRow<Dim> make_row(const Grids<Dim>& grids, int field, const std::vector<NodeVector<Dim>>& vectors) {
  return make_row<Dim>(grids, {{field, 1, vectors}});
}

RawRow<2> along(RawRow<2> normal) {
  for (auto& entry : normal.entries) entry.value = {-entry.value[1], entry.value[0]};
  return normal;
}

template <int Dim>
bool Rows<Dim>::add(const RawRow<Dim>& row) {
  std::vector<NodeEntry<Dim>> entries;
  entries.reserve(row.entries.size());
  for (const auto& [field, node, value] : row.entries) entries.push_back({places_.of(field, node), value});
  if (row.complete) rows_.push_back(std::move(entries));
  return row.complete;
}

template <int Dim>
NodeRows<Dim> Rows<Dim>::matrix() const {
  NodeRows<Dim> E{rows_, places_.list().size()};
  const auto count = static_cast<std::ptrdiff_t>(E.rows.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t r = 0; r < count; ++r) {
    auto& row = E.rows[r];
    for (auto& [place, value] : row)
      for (int a = 0; a < Dim; ++a)
        if (places_.list()[place].fixed[a]) value[a] = 0;
    std::sort(row.begin(), row.end(), [](const auto& one, const auto& other) { return one.place < other.place; });
  }
  return E;
}

template <int Dim>
Drag Rows<Dim>::drag(double dt) {
  struct Pair {
    int water, soil;
    double water_share, soil_share;  // dt c / m
  };
  std::vector<Pair> pairs;
  std::vector<int> soil_of(grids_.size(), -1);
  for (const Grid<Dim>& grid : grids_)
    if (grid.pore_water >= 0) soil_of[grid.pore_water] = grid.field;
  for (std::size_t k = 0; k < places_.list().size(); ++k) {  // grows
    const auto [field, node] = std::pair(places_.list()[k].field, places_.list()[k].node);
    const int soil = grids_[field].pore_water >= 0 ? field : soil_of[field];
    if (soil < 0) continue;
    const Grid<Dim>&grid = grids_[soil], &around = grids_[grid.pore_water];
    const double c = dt * around.node_drag[node];
    if (!(c > 0 && grid.sum[node][3] > 0 && around.sum[node][3] > 0)) continue;
    const int of_water = places_.of(around.field, node), of_soil = places_.of(soil, node);
    pairs.push_back({of_water, of_soil, c / around.sum[node][3], c / grid.sum[node][3]});
  }
  if (pairs.empty()) return {};
  Drag out(places_.list().size());
  for (const auto& [water, soil, of_water, of_soil] : pairs) {  // both of a pair name it
    const double scale = 1 / (1 + of_water + of_soil), both = std::sqrt(of_water * of_soil) * scale;
    out[water] = {(1 + of_soil) * scale, both, soil};
    out[soil] = {(1 + of_water) * scale, both, water};
  }
  return out;
}

template <int Dim>
Eigen::VectorXd Rows<Dim>::scaled_velocities() const {
  const auto& places = places_.list();
  Eigen::VectorXd scaled(Dim * places.size());
  for (std::size_t n = 0; n < places.size(); ++n)
    for (int a = 0; a < Dim; ++a)
      scaled[Dim * n + a] = places[n].root_mass * grids_[places[n].field].velocity[places[n].node][a];
  return scaled;
}

template <int Dim>
void apply_pressures(const Rows<Dim>& rows, const ByPlace<Dim>& E, const Eigen::VectorXd& pressure, double dt,
                     Grids<Dim>& grids) {
  const auto places = static_cast<std::ptrdiff_t>(E.places());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t n = 0; n < places; ++n) {
    std::array<double, Dim> impulse{};
    for (const auto& [row, value] : E.at(n))
      for (int a = 0; a < Dim; ++a) impulse[a] += -dt * value[a] * pressure[row];
    const auto& place = rows.places().list()[n];
    Grid<Dim>& grid = grids[place.field];
    for (int a = 0; a < Dim; ++a) {
      const double v = impulse[a] / place.root_mass;
      grid.velocity[place.node][a] += v;
      if (!grid.velocity_change.empty()) grid.velocity_change[place.node][a] += v;
    }
  }
}

template class Places<2>;
template class Places<3>;
template RawRow<2> make_row(const Grids<2>&, std::initializer_list<TermOfRow<2>>);
template RawRow<3> make_row(const Grids<3>&, std::initializer_list<TermOfRow<3>>);
template RawRow<2> make_row(const Grids<2>&, int, int, const std::vector<NodeVector<2>>&);
template RawRow<3> make_row(const Grids<3>&, int, int, const std::vector<NodeVector<3>>&);
template RawRow<2> make_row(const Grids<2>&, int, const std::vector<NodeVector<2>>&);
template RawRow<3> make_row(const Grids<3>&, int, const std::vector<NodeVector<3>>&);
template class Rows<2>;
template class Rows<3>;
template void apply_pressures(const Rows<2>&, const ByPlace<2>&, const Eigen::VectorXd&, double, Grids<2>&);
template void apply_pressures(const Rows<3>&, const ByPlace<3>&, const Eigen::VectorXd&, double, Grids<3>&);

}  // namespace geodrop
