#include "cut_cells.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.hpp"

namespace geodrop {
namespace {

/// Integrals of 1, z, z^2 from one z to another.
FaceMoments moments_between(double from, double to) {
  return {to - from, (to * to - from * from) / 2, (to * to * to - from * from * from) / 3};
}

void add(double factor, const FaceMoments& what, FaceMoments& to) {
  for (std::size_t b = 0; b < what.size(); ++b) to[b] += factor * what[b];
}

/// Where from + t * length passes whole numbers.
void add_crossings(double from, double length, std::vector<double>& cuts) {
  if (length == 0) return;
  const double low = std::min(from, from + length), high = std::max(from, from + length);
  for (double line = std::ceil(low); line < high; ++line) cuts.push_back((line - from) / length);
}

/// Box of stored cell coordinates around the polygon, with a margin of one cell.
void set_box(const GridLayout<2>& layout, const Array<double>& x, const Array<double>& y, CutCells& cells) {
  constexpr int margin = 1;
  for (int a = 0; a < 2; ++a) {
    const Array<double>& values = a == 0 ? x : y;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    cells.first[a] = layout.base(a, *low) + GridLayout<2>::pad - margin;
    cells.count[a] = layout.base(a, *high) + GridLayout<2>::pad + margin + 1 - cells.first[a];
  }
  const auto n = static_cast<std::size_t>(cells.count[0]) * cells.count[1];
  cells.area.assign(n, 0.0);
  cells.right_face.assign(n, FaceMoments{});
  cells.top_face.assign(n, FaceMoments{});
  cells.pieces.clear();
}

/// An edge along a face of cells at the end of the box may be beyond that by round-off: it belongs to the cell before,
/// whose neighbours are in the box.
int within_margin(int i, int count) { return std::clamp(i, 1, count - 2); }

/// A place and the way along an edge as the cell sees them, from its middle in its own widths.
struct InCell {
  int i, j;  ///< in the box
  double xi, eta, d_xi, d_eta;
};

/// An edge in units of h from the lower corner of the box.
struct UniformEdge {
  double u, v, du, dv;
  std::array<int, 2> count;

  UniformEdge(const GridLayout<2>& layout, const CutCells& cells, const Vec<2>& from, const Vec<2>& along)
      : u((from[0] - layout.lower[0]) * layout.inv_h + (0.5 + GridLayout<2>::pad - cells.first[0])),
        v((from[1] - layout.lower[1]) * layout.inv_h + (0.5 + GridLayout<2>::pad - cells.first[1])),
        du(along[0] * layout.inv_h),
        dv(along[1] * layout.inv_h),
        count(cells.count) {}

  void add_cuts(std::vector<double>& cuts) const {
    add_crossings(u, du, cuts);
    add_crossings(v, dv, cuts);
  }
  InCell in_cell_at(double t) const {
    const int i = within_margin(static_cast<int>(u + t * du), count[0]);
    const int j = within_margin(static_cast<int>(v + t * dv), count[1]);
    return {i, j, u - i - 0.5, v - j - 0.5, du, dv};
  }
};

/// An edge between knots of unlike distance.
class GradedEdge {
 public:
  GradedEdge(const GridLayout<2>& layout, const CutCells& cells, const Vec<2>& from, const Vec<2>& along)
      : layout_(layout), cells_(cells), from_(from), along_(along) {}

  void add_cuts(std::vector<double>& cuts) const {
    for (int a = 0; a < 2; ++a) {
      const KnotTable& knots = layout_.knots[a];
      const double low = std::min(from_[a], from_[a] + along_[a]), high = std::max(from_[a], from_[a] + along_[a]);
      for (int k = knots.find(low) + 1; knots[k].left < high; ++k)
        cuts.push_back((knots[k].left - from_[a]) / along_[a]);
    }
  }
  InCell in_cell_at(double t) const {
    std::array<int, 2> cell;
    std::array<double, 2> z, d_z;
    for (int a = 0; a < 2; ++a) {
      const KnotTable& knots = layout_.knots[a];
      cell[a] = within_margin(knots.find(from_[a] + t * along_[a]) - cells_.first[a], cells_.count[a]);
      const int k = cells_.first[a] + cell[a];
      z[a] = (from_[a] - knots.node(k)) / knots[k].width;
      d_z[a] = along_[a] / knots[k].width;
    }
    return {cell[0], cell[1], z[0], z[1], d_z[0], d_z[1]};
  }

 private:
  const GridLayout<2>& layout_;
  const CutCells& cells_;
  Vec<2> from_, along_;
};

/// Cuts an edge at the faces of cells. What each piece adds to lines beside and below it is left in the entries of its
/// own cell: faces are summed up later.
template <class Edge>
void add_edge(const Edge& edge, int number, std::vector<double>& cuts, CutCells& cells) {
  const double sign = cells.sense;
  cuts.assign({0.0, 1.0});
  edge.add_cuts(cuts);
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t n = 1; n < cuts.size(); ++n) {
    const double from = cuts[n - 1], to = cuts[n], middle = 0.5 * (from + to);
    if (to <= from) continue;
    const auto [i, j, xi, eta, d_xi, d_eta] = edge.in_cell_at(middle);
    const int cell = i + j * cells.count[0];
    cells.area[cell] += sign * (xi + middle * d_xi + 0.5) * (to - from) * d_eta;
    add(sign, moments_between(eta + from * d_eta, eta + to * d_eta), cells.right_face[cell]);
    add(-sign, moments_between(xi + from * d_xi, xi + to * d_xi), cells.top_face[cell]);
    cells.pieces.push_back({cell, number, from, to});
  }
}

template <class Edge>
void add_edges(const GridLayout<2>& layout, const Array<double>& x, const Array<double>& y, CutCells& cells) {
  std::vector<double> cuts;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const std::size_t next = end_of_edge(k, x.size());
    const Edge edge(layout, cells, {x[k], y[k]}, {x[next] - x[k], y[next] - y[k]});
    add_edge(edge, static_cast<int>(k), cuts, cells);
  }
}

/// The part of a face inside is the sum over all pieces beyond it.
void sum_up(int first, int step, int count, Array<FaceMoments>& face, Array<double>* area) {
  FaceMoments beyond{};
  for (int n = count - 1; n >= 0; --n) {
    const int cell = first + n * step;
    const FaceMoments own = face[cell];
    face[cell] = beyond;
    if (area) (*area)[cell] += beyond[0];
    add(1, own, beyond);
  }
}

}  // namespace

void cut_cells(const GridLayout<2>& layout, const Array<double>& x, const Array<double>& y, CutCells& cells) {
  set_box(layout, x, y, cells);
  cells.sense = signed_area(x, y) > 0 ? 1 : -1;
  if (layout.graded())
    add_edges<GradedEdge>(layout, x, y, cells);
  else
    add_edges<UniformEdge>(layout, x, y, cells);
  const auto [nx, ny] = cells.count;
  for (int j = 0; j < ny; ++j) sum_up(j * nx, 1, nx, cells.right_face, &cells.area);
  for (int i = 0; i < nx; ++i) sum_up(i, nx, ny, cells.top_face, nullptr);
}

}  // namespace geodrop
