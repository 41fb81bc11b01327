#include "anchor_rows.hpp"

#include <geodrop/base/find_named.hpp>

#include <cmath>

#include "cells_around.hpp"
#include "grid/point_support.hpp"

namespace geodrop {
namespace {

/// e . v_k, times `scale`.
template <int Dim>
RawRow<Dim> row_at(const Grids<Dim>& grids, const Membrane<Dim>& membrane, std::uint32_t node, const Vec<Dim>& vector) {
  const GridLayout<Dim>& layout = grids[membrane.field].layout;
  std::vector<NodeVector<Dim>> vectors;
  PointSupport<Dim>(layout, place_at(membrane.x, node), membrane.half_size)
      .for_each_node(layout, [&](int at, double weight) {
        NodeVector<Dim>& out = vectors.emplace_back(NodeVector<Dim>{at, {}});
        for (int a = 0; a < Dim; ++a) out.value[a] = weight * vector[a];
      });
  return make_row(grids, membrane.field, vectors);
}

}  // namespace

template <int Dim>
AnchorRows<Dim> anchor_rows(State<Dim>& state, const Grids<Dim>& grids) {
  AnchorRows<Dim> rows;
  const double scale = std::pow(grids.front().layout.h, Dim - 1);
  for (Anchor<Dim>& anchor : state.anchors) {
    const Membrane<Dim>& membrane = find_named(state.membranes, anchor.membrane);
    if (!acts_sharply(membrane)) continue;
    const auto add = [&](const Vec<Dim>& along, double gap) {
      AnchorRow<Dim> row{&anchor, along, gap, scale, row_at<Dim>(grids, membrane, anchor.node, scale * along)};
      if (row.row.complete) rows.push_back(std::move(row));
    };
    const Vec<Dim> off = vector_at(membrane.x, anchor.node) - Vec<Dim>(anchor.to.data());
    if (!anchor.line) {
      for (int a = 0; a < Dim; ++a) add(Vec<Dim>::Unit(a), off[a]);
    } else if (const double distance = off.norm(); distance > 0) {
      add(off / distance, distance - anchor.length);
    }
  }
  return rows;
}

template <int Dim>
void add_laws(const AnchorRows<Dim>& rows, double dt, SparseRows& S, Eigen::VectorXd& rate) {
  Eigen::Index r = rate.size() - static_cast<Eigen::Index>(rows.size());
  for (const AnchorRow<Dim>& row : rows) {
    const double yields = row.scale * row.scale * row.anchor->compliance / (dt * dt);
    if (yields > 0) S.coeffRef(r, r) += yields;
    rate[r++] += row.scale * row.gap / (dt * dt);
  }
}

template <int Dim>
void keep_forces(const AnchorRows<Dim>& rows, double dt, const Eigen::VectorXd& multipliers,
                 const Eigen::VectorXd& missing) {
  for (const AnchorRow<Dim>& row : rows) row.anchor->force.fill(0);
  Eigen::Index r = multipliers.size() - static_cast<Eigen::Index>(rows.size());
  for (const AnchorRow<Dim>& row : rows) {
    const double pull = row.scale * multipliers[r];
    for (int a = 0; a < Dim; ++a) row.anchor->force[a] -= pull * row.along[a];
    if (row.anchor->line) row.anchor->stretch = row.anchor->compliance * pull + dt * dt * missing[r] / row.scale;
    ++r;
  }
}

#define GEODROP_INSTANTIATE(D)                                                         \
  template AnchorRows<D> anchor_rows(State<D>&, const Grids<D>&);                      \
  template void add_laws(const AnchorRows<D>&, double, SparseRows&, Eigen::VectorXd&); \
  template void keep_forces(const AnchorRows<D>&, double, const Eigen::VectorXd&, const Eigen::VectorXd&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
