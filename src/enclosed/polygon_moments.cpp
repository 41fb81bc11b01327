#include "polygon_moments.hpp"

#include <algorithm>
#include <cmath>

namespace geodrop {
namespace {

/// A straight piece within one cell, in units of h from the cell's centre.
struct Piece {
  double xi, eta, d_xi, d_eta;
};

double signed_area(const Array<double>& x, const Array<double>& y) {
  double twice = 0;
  for (std::size_t k = 0, next = 1; k < x.size(); ++k, ++next) {
    if (next == x.size()) next = 0;
    twice += x[k] * y[next] - x[next] * y[k];
  }
  return twice / 2;
}

/// What lies left of the piece: the part of its own cell, and the heights int eta^b for whole cells.
void add_piece(const Piece& piece, double sign, CellMoments& own, std::array<double, 3>& heights) {
  // Gauss points: exact to degree 5, that of eta^2 xi^3 along the piece.
  const double off = std::sqrt(0.15);
  const double points[] = {0.5 - off, 0.5, 0.5 + off}, weights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  for (int g = 0; g < 3; ++g) {
    const double xi = piece.xi + points[g] * piece.d_xi, eta = piece.eta + points[g] * piece.d_eta;
    const double weight = sign * weights[g] * piece.d_eta;
    const double widths[] = {xi + 0.5, (xi * xi - 0.25) / 2, (xi * xi * xi + 0.125) / 3};
    double power = weight;
    for (int b = 0; b < 3; ++b, power *= eta) {
      heights[b] += power;
      for (int a = 0; a < 3; ++a) own[3 * a + b] += power * widths[a];
    }
  }
}

/// Calls f(t0, t1) for the parts of the unit interval between the whole numbers that from + t * length passes.
void add_crossings(double from, double length, std::vector<double>& cuts) {
  if (length == 0) return;
  const double low = std::min(from, from + length), high = std::max(from, from + length);
  for (double line = std::ceil(low); line < high; ++line) cuts.push_back((line - from) / length);
}

/// Box of stored cell coordinates around the polygon.
void set_box(const GridLayout<2>& layout, const Array<double>& x, const Array<double>& y, EnclosedCells& cells) {
  for (int a = 0; a < 2; ++a) {
    const Array<double>& values = a == 0 ? x : y;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    constexpr int margin = 1;
    cells.first[a] = layout.base(a, *low) + GridLayout<2>::pad - margin;
    cells.count[a] = layout.base(a, *high) + GridLayout<2>::pad + margin + 1 - cells.first[a];
  }
}

}  // namespace

void cover_polygon(const GridLayout<2>& layout, const Array<double>& x, const Array<double>& y, EnclosedCells& cells) {
  set_box(layout, x, y, cells);
  const int nx = cells.count[0], ny = cells.count[1];
  cells.moments.assign(static_cast<std::size_t>(nx) * ny, CellMoments{});
  std::vector<std::array<double, 3>> heights(cells.moments.size(), std::array<double, 3>{});
  const double sign = signed_area(x, y) > 0 ? 1 : -1;
  const double to_box[] = {0.5 + GridLayout<2>::pad - cells.first[0], 0.5 + GridLayout<2>::pad - cells.first[1]};
  std::vector<double> cuts;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const std::size_t next = k + 1 == x.size() ? 0 : k + 1;
    const double u = (x[k] - layout.lower[0]) * layout.inv_h + to_box[0], du = (x[next] - x[k]) * layout.inv_h;
    const double v = (y[k] - layout.lower[1]) * layout.inv_h + to_box[1], dv = (y[next] - y[k]) * layout.inv_h;
    cuts.assign({0.0, 1.0});
    add_crossings(u, du, cuts);
    add_crossings(v, dv, cuts);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t c = 1; c < cuts.size(); ++c) {
      const double t = cuts[c - 1], dt = cuts[c] - t, middle = t + 0.5 * dt;
      if (dt <= 0) continue;
      const int i = static_cast<int>(u + middle * du), j = static_cast<int>(v + middle * dv);
      const Piece piece{u + t * du - i - 0.5, v + t * dv - j - 0.5, dt * du, dt * dv};
      add_piece(piece, sign, cells.moments[i + j * nx], heights[i + j * nx]);
    }
  }
  for (int j = 0; j < ny; ++j) {
    std::array<double, 3> right{};  // of all pieces further right in the row
    for (int i = nx - 1; i >= 0; --i) {
      CellMoments& m = cells.moments[i + j * nx];
      for (int b = 0; b < 3; ++b) {
        m[b] += right[b];
        m[6 + b] += right[b] / 12;
        right[b] += heights[i + j * nx][b];
      }
    }
  }
}

CellGradients gradient_integrals(const CellMoments& m, double h) {
  // Coefficients of N and N' of the nodes below, at and above a cell, in powers of the local coordinate.
  constexpr double value[3][3] = {{0.125, -0.5, 0.5}, {0.75, 0, -1}, {0.125, 0.5, 0.5}};
  constexpr double slope[3][2] = {{-0.5, 1}, {0, -2}, {0.5, 1}};
  CellGradients out;
  for (int j = 0; j < 3; ++j) {
    double by_value[3], by_slope[3];  // sums over the powers of eta
    for (int a = 0; a < 3; ++a) {
      by_value[a] = value[j][0] * m[3 * a] + value[j][1] * m[3 * a + 1] + value[j][2] * m[3 * a + 2];
      by_slope[a] = slope[j][0] * m[3 * a] + slope[j][1] * m[3 * a + 1];
    }
    for (int i = 0; i < 3; ++i)
      out[3 * j + i] = {h * (slope[i][0] * by_value[0] + slope[i][1] * by_value[1]),
                        h * (value[i][0] * by_slope[0] + value[i][1] * by_slope[1] + value[i][2] * by_slope[2])};
  }
  return out;
}

}  // namespace geodrop
