#include "contact_rows.hpp"

#include <algorithm>
#include <utility>

#include "cells_around.hpp"

namespace geodrop {
namespace {

/// n v_w + (1 - n) v_g around meet the membrane, with the grains of a coupled bed; n is 1 elsewhere.
template <int Dim>
RawRow<Dim> row_of_mixture(const Grids<Dim>& grids, int field, int grains,
                           const std::vector<NodeVector<Dim>>& vectors) {
  std::vector<NodeVector<Dim>> of_water = vectors, of_grains;
  for (NodeVector<Dim>& vector : of_water) {
    const double n = grids.front().pore_share[vector.node];
    if (n == 1) continue;
    of_grains.push_back(vector);
    for (double& value : of_grains.back().value) value *= 1 - n;
    for (double& value : vector.value) value *= n;
  }
  if (of_grains.empty()) return make_row(grids, field, 0, vectors);
  return make_row<Dim>(grids, {{field, 1, vectors}, {0, -1, of_water}, {grains, -1, of_grains}});
}

template <int Dim>
RowsOfContact<Dim> rows_of(const Grids<Dim>& grids, int grains, const Contact<Dim>& contact) {
  const int field = contact.membrane->field;
  const Grid<Dim>& grid = grids[field];
  std::vector<NodeVector<Dim>> vectors = normals_of(grid.layout, grid.outline, contact);
  RowsOfContact<Dim> rows;
  if (contact.stretch.wet)
    rows.normal = grains < 0 ? make_row(grids, field, 0, vectors) : row_of_mixture(grids, field, grains, vectors);
  if (contact.on_grains) rows.grains = make_row(grids, field, grains, vectors);
  if (contact.membrane->pore_pressure.empty()) return rows;
  for (NodeVector<Dim>& vector : vectors)
    for (double& value : vector.value) value *= grids[grid.pore_water].pore_share[vector.node];
  rows.through = make_row(grids, grid.pore_water, field, vectors);
  return rows;
}

}  // namespace

template <int Dim>
std::vector<RowsOfContact<Dim>> rows_of(const Grids<Dim>& grids, const std::vector<Contact<Dim>>& contacts) {
  std::vector<RowsOfContact<Dim>> rows(contacts.size());
  const auto count = static_cast<std::ptrdiff_t>(contacts.size());
  const int grains = grains_around(grids);
#pragma omp parallel for schedule(dynamic, 4)
  for (std::ptrdiff_t c = 0; c < count; ++c) rows[c] = rows_of(grids, grains, contacts[c]);
  return rows;
}

RawRow<2> along(const Contact<2>&, Says, const RawRow<2>& normal) { return along(normal); }
RawRow<3> along(const Contact<3>& contact, Says says, RawRow<3> normal) {
  const std::array<double, 3>&axis = contact.axes[0], &way = contact.axes[says == Says::tangent ? 1 : 2];
  for (auto& entry : normal.entries) {
    const double part = axis[0] * entry.value[0] + axis[1] * entry.value[1] + axis[2] * entry.value[2];
    for (std::size_t a = 0; a < 3; ++a) entry.value[a] = part * way[a];
  }
  return normal;
}

template <int Dim>
void store(const ContactRows<Dim>& rows, const Eigen::VectorXd& traction, const Grids<Dim>& grids,
           std::vector<Contact<Dim>>& contacts) {
  for (std::size_t r = 0; r < rows.list().size(); ++r) {
    const std::size_t c = rows.list()[r].contact;
    const Says says = rows.list()[r].says;
    Membrane<Dim>& membrane = *contacts[c].membrane;
    const Outline<Dim>& cells = grids[membrane.field].outline;
    const double of_row = traction[static_cast<Eigen::Index>(r)];
    if (says == Says::normal) contacts[c].pressure = of_row;
    if (says == Says::grains) contacts[c].of_grains = of_row;
    for_each_share(cells, contacts[c].stretch, [&](std::size_t at, double share) {
      add_traction(contacts[c], cells, says, at, share * of_row);
      if (says != Says::through || contacts[c].on_bed) return;
      const double flow = share * contacts[c].permeance * (of_row - contacts[c].pressure);
      membrane.seepage[at] += contacts[c].in_air ? std::max(0.0, flow) : flow;  // no water comes out of air
    });
  }
}

template <int Dim>
System system_of(const NodeRows<Dim>& dragged, const ByPlace<Dim>& by_place, const Eigen::VectorXd& velocity_rate) {
  return {symmetric_product(dragged, by_place), times(dragged, velocity_rate)};
}

template std::vector<RowsOfContact<2>> rows_of(const Grids<2>&, const std::vector<Contact<2>>&);
template std::vector<RowsOfContact<3>> rows_of(const Grids<3>&, const std::vector<Contact<3>>&);
template void store(const ContactRows<2>&, const Eigen::VectorXd&, const Grids<2>&, std::vector<Contact<2>>&);
template void store(const ContactRows<3>&, const Eigen::VectorXd&, const Grids<3>&, std::vector<Contact<3>>&);
template System system_of(const NodeRows<2>&, const ByPlace<2>&, const Eigen::VectorXd&);
template System system_of(const NodeRows<3>&, const ByPlace<3>&, const Eigen::VectorXd&);

}  // namespace geodrop
