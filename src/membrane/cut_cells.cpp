#include "cut_cells.hpp"

#include <algorithm>
#include <cmath>

#include "polygon.hpp"

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

/// An edge in units of h from the lower corner of the box.
struct Edge {
  double u, v, du, dv;
};

/// Cuts an edge at the faces of cells. What each piece adds to lines beside and below it is left in the entries of its
/// own cell: faces are summed up later.
void add_edge(const Edge& edge, int number, double sign, std::vector<double>& cuts, CutCells& cells) {
  cuts.assign({0.0, 1.0});
  add_crossings(edge.u, edge.du, cuts);
  add_crossings(edge.v, edge.dv, cuts);
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t n = 1; n < cuts.size(); ++n) {
    const double from = cuts[n - 1], to = cuts[n], middle = 0.5 * (from + to);
    if (to <= from) continue;
    const int i = static_cast<int>(edge.u + middle * edge.du), j = static_cast<int>(edge.v + middle * edge.dv);
    const double xi = edge.u - i - 0.5, eta = edge.v - j - 0.5;
    const int cell = i + j * cells.count[0];
    cells.area[cell] += sign * (xi + middle * edge.du + 0.5) * (to - from) * edge.dv;
    add(sign, moments_between(eta + from * edge.dv, eta + to * edge.dv), cells.right_face[cell]);
    add(-sign, moments_between(xi + from * edge.du, xi + to * edge.du), cells.top_face[cell]);
    cells.pieces.push_back({cell, number, from, to});
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
  const double to_box[] = {0.5 + GridLayout<2>::pad - cells.first[0], 0.5 + GridLayout<2>::pad - cells.first[1]};
  std::vector<double> cuts;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const std::size_t next = end_of_edge(k, x.size());
    const Edge edge{(x[k] - layout.lower[0]) * layout.inv_h + to_box[0],
                    (y[k] - layout.lower[1]) * layout.inv_h + to_box[1], (x[next] - x[k]) * layout.inv_h,
                    (y[next] - y[k]) * layout.inv_h};
    add_edge(edge, static_cast<int>(k), cells.sense, cuts, cells);
  }
  const auto [nx, ny] = cells.count;
  for (int j = 0; j < ny; ++j) sum_up(j * nx, 1, nx, cells.right_face, &cells.area);
  for (int i = 0; i < nx; ++i) sum_up(i, nx, ny, cells.top_face, nullptr);
}

}  // namespace geodrop
