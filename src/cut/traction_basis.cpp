#include "traction_basis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cells_around.hpp"
#include "cut_cells.hpp"
#include "geometry/polygon.hpp"
#include "membrane/outline.hpp"
#include "membrane/part_size.hpp"

namespace geodrop {
namespace {

/// Lengths are in cells, see cells_along.
constexpr double least_between_knots = 1;

/// Angle by which an outline turns at a corner [rad].
constexpr double least_turn = 0.6;

/// Angle by which an outline turns at the start of a segment [rad].
double turn_at(const Membrane<2>& membrane, std::size_t segment) {
  const std::size_t before = node_before(membrane, segment), after = end_of_edge(segment, membrane.nodes());
  const auto& [x, y] = membrane.x;
  const double ax = x[segment] - x[before], ay = y[segment] - y[before];
  const double bx = x[after] - x[segment], by = y[after] - y[segment];
  return std::abs(std::atan2(ax * by - ay * bx, ax * bx + ay * by));
}

struct Corner {
  double place, turn;
};

/// Stretches that follow each other, measured along the outline.
struct Run {
  std::vector<std::size_t> contacts;
  bool closed = false;          ///< the first follows the last
  std::vector<double> ends{0};  ///< of each stretch, after the start of the first
  std::vector<Corner> corners;
  double first_node = 0;  ///< where the outline's first node is, if the run is closed

  double length() const { return ends.back(); }
};

void append(const Grid<2>& grid, const std::vector<Contact<2>>& contacts, std::size_t c, Run& run) {
  const Membrane<2>& membrane = *contacts[c].membrane;
  double at = run.length();
  for_each_piece(grid.outline, contacts[c].stretch, [&](const CutCells::Piece& piece) {
    if (piece.from == 0) {
      const auto segment = static_cast<std::size_t>(piece.edge);
      if (segment == 0) run.first_node = at;
      if (const double turn = turn_at(membrane, segment); turn > least_turn) run.corners.push_back({at, turn});
    }
    at += cells_along(grid.layout, membrane, grid.outline, piece);
  });
  run.contacts.push_back(c);
  run.ends.push_back(at);
}

/// Knots from one place to the next, at least one interval in each, their number a multiple of `multiple`.
std::vector<double> divide(const std::vector<double>& places, int multiple) {
  std::vector<double> knots{places.front()};
  for (std::size_t k = 1; k < places.size(); ++k) {
    const double from = places[k - 1], part = places[k] - from;
    const int n = multiple * std::max(1, static_cast<int>(std::lround(part / (multiple * between_knots))));
    for (int i = 1; i < n; ++i) knots.push_back(from + part * i / n);
    knots.push_back(places[k]);
  }
  return knots;
}

/// Corners within a cell are one, at their mean place: a round tip that the grid does not resolve has several.
std::vector<double> places_of(const std::vector<Corner>& corners) {
  std::vector<double> places;
  for (std::size_t k = 0, next; k < corners.size(); k = next) {
    double turn = 0, moment = 0;
    for (next = k; next < corners.size() && corners[next].place - corners[k].place <= least_between_knots; ++next) {
      turn += corners[next].turn;
      moment += corners[next].turn * corners[next].place;
    }
    places.push_back(moment / turn);
  }
  return places;
}

/// Adds places up to `to` that are not close to the last one or to it.
void add_apart(const std::vector<double>& more, double to, std::vector<double>& places) {
  for (const double place : more)
    if (place - places.back() > least_between_knots && to - place > least_between_knots) places.push_back(place);
  places.push_back(to);
}

/// The same corners once round, from one on that has none close before it.
std::vector<Corner> from_gap(std::vector<Corner> corners, double length) {
  const auto is_close = [&](const Corner& a, const Corner& b) { return b.place - a.place <= least_between_knots; };
  Corner before = corners.back();
  before.place -= length;
  std::size_t start = 0;
  while (start < corners.size() && is_close(start == 0 ? before : corners[start - 1], corners[start])) ++start;
  start %= corners.size();
  for (std::size_t k = 0; k < start; ++k) corners[k].place += length;
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(start), corners.end());
  return corners;
}

/// Knots of a run that closes on itself, the last one on the first. One without corners starts at its first node and
/// has a number of knots that leaves an outline as symmetric as it is.
std::vector<double> knots_of_closed(const Run& run) {
  constexpr int of_symmetric = 4;
  if (run.corners.empty()) return divide({run.first_node, run.first_node + run.length()}, of_symmetric);
  const std::vector<double> corners = places_of(from_gap(run.corners, run.length()));
  std::vector<double> places{corners.front()};
  add_apart(corners, places.front() + run.length(), places);
  return divide(places, 1);
}

/// A single one if the run is short: its pressure is constant.
std::vector<double> knots_of_open(const Run& run) {
  if (run.length() < 0.75 * between_knots) return {0};
  std::vector<double> places{0};
  add_apart(places_of(run.corners), run.length(), places);
  return divide(places, 1);
}

/// Means over [from, to] of the functions that are 1 at a knot and fall to 0 at the knots beside it: f(interval, that
/// of the knot at its start, that of the knot at its end).
template <class F>
void for_each_mean(const std::vector<double>& knots, double from, double to, F&& f) {
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double start = std::max(from, knots[i]), end = std::min(to, knots[i + 1]);
    if (!(end > start)) continue;
    const double part = (end - start) / (to - from);
    const double middle = (0.5 * (start + end) - knots[i]) / (knots[i + 1] - knots[i]);
    f(i, part * (1 - middle), part * middle);
  }
}

/// Numbers the knots of a run from `first` on; returns the number after them.
int share_out(const Run& run, int first, std::vector<KnotShares>& shares) {
  std::vector<double> knots = run.closed ? knots_of_closed(run) : knots_of_open(run);
  if (knots.size() == 1) {
    for (const std::size_t c : run.contacts) shares[c] = {{first, 1}};
    return first + 1;
  }
  const std::size_t count = run.closed ? knots.size() - 1 : knots.size();
  if (run.closed) {  // once round before, as the first stretch may begin there
    std::vector<double> before(knots.begin(), knots.end() - 1);
    for (double& knot : before) knot -= run.length();
    knots.insert(knots.begin(), before.begin(), before.end());
  }
  for (std::size_t k = 0; k < run.contacts.size(); ++k)
    for_each_mean(knots, run.ends[k], run.ends[k + 1], [&](std::size_t i, double of_start, double of_end) {
      add(first + static_cast<int>(i % count), of_start, shares[run.contacts[k]]);
      add(first + static_cast<int>((i + 1) % count), of_end, shares[run.contacts[k]]);
    });
  return first + static_cast<int>(count);
}

/// The runs of contacts [first, last), those of one membrane.
std::vector<Run> runs_of(const Grid<2>& grid, const std::vector<Contact<2>>& contacts, std::size_t first,
                         std::size_t last) {
  const std::size_t n = last - first, pieces = grid.outline.pieces.size();
  const auto after = [&](std::size_t c) { return c + 1 < last ? c + 1 : first; };
  const auto goes_on = [&](std::size_t c) {
    const Contact<2>&one = contacts[c], &next = contacts[after(c)];
    return one.has_rows && next.has_rows && one.stretch.wet == next.stretch.wet && one.on_bed == next.on_bed &&
           one.in_air == next.in_air && (one.stretch.first + one.stretch.count) % pieces == next.stretch.first;
  };
  std::size_t start = first, last_of_run = first;
  while (last_of_run < last && goes_on(last_of_run)) ++last_of_run;
  const bool closed = last_of_run == last;
  if (!closed) start = after(last_of_run);
  std::vector<Run> runs;
  bool open = false;
  for (std::size_t k = 0, c = start; k < n; ++k, c = after(c)) {
    if (contacts[c].has_rows) {
      if (!open) runs.emplace_back();
      append(grid, contacts, c, runs.back());
    }
    open = goes_on(c);
  }
  if (closed) runs.front().closed = true;
  return runs;
}

std::vector<KnotShares> shares_of(const std::vector<Contact<2>>& contacts, const Grids<2>& grids) {
  std::vector<KnotShares> shares(contacts.size());
  int knots = 0;
  for (std::size_t first = 0, last; first < contacts.size(); first = last) {
    last = first;
    while (last < contacts.size() && contacts[last].membrane == contacts[first].membrane) ++last;
    for (const Run& run : runs_of(grids[contacts[first].membrane->field], contacts, first, last))
      knots = share_out(run, knots, shares);
  }
  return shares;
}

/// Stretches on the bed, which may only push, have a pressure of their own, after those of all knots.
std::vector<KnotShares> shares_of(const std::vector<Contact<3>>& contacts, const Grids<3>& grids) {
  std::vector<KnotShares> shares(contacts.size());
  int first = 0, next = 0;  // knots of the membrane at hand, and after them
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact<3>& contact = contacts[c];
    if (c == 0 || contact.membrane != contacts[c - 1].membrane) {
      first = next;
      next += contact.knots->count;
    }
    if (contact.on_bed) continue;
    for_each_share(grids[contact.membrane->field].outline, contact.stretch, [&](std::size_t triangle, double share) {
      const double part = share * size_of(*contact.membrane, triangle) / contact.stretch.size;
      for (const auto& [knot, value] : contact.knots->of_triangle[triangle]) add(first + knot, part * value, shares[c]);
    });
  }
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (contacts[c].on_bed) shares[c] = {{next++, 1}};
  return shares;
}

template <int Dim>
SparseRows basis_of(const std::vector<Contact<Dim>>& contacts, const Grids<Dim>& grids,
                    const std::vector<RowOfContact>& rows, std::size_t others) {
  const std::vector<KnotShares> shares = shares_of(contacts, grids);
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> across, through, grains;  // columns of knots
  int row = 0, columns = 0;
  const auto column_of = [&](int knot, std::vector<int>& of_knots) {
    if (static_cast<std::size_t>(knot) >= of_knots.size()) of_knots.resize(static_cast<std::size_t>(knot) + 1, -1);
    int& column = of_knots[static_cast<std::size_t>(knot)];
    if (column < 0) column = columns++;
    return column;
  };
  for (const auto& [contact, says] : rows) {
    std::vector<int>* const of_knots = says == Says::normal               ? &across
                                       : says == Says::through            ? &through
                                       : says == Says::grains && Dim == 2 ? &grains
                                                                          : nullptr;
    if (of_knots)
      for (const auto& [knot, value] : shares[contact]) entries.emplace_back(row, column_of(knot, *of_knots), value);
    else
      entries.emplace_back(row, columns++, 1);
    ++row;
  }
  for (std::size_t k = 0; k < others; ++k) entries.emplace_back(row++, columns++, 1);
  SparseRows basis(row, columns);
  basis.setFromTriplets(entries.begin(), entries.end());
  return basis;
}

}  // namespace

SparseRows traction_basis(const std::vector<Contact<2>>& contacts, const Grids<2>& grids,
                          const std::vector<RowOfContact>& rows, std::size_t others) {
  return basis_of(contacts, grids, rows, others);
}
SparseRows traction_basis(const std::vector<Contact<3>>& contacts, const Grids<3>& grids,
                          const std::vector<RowOfContact>& rows, std::size_t others) {
  return basis_of(contacts, grids, rows, others);
}

}  // namespace geodrop
