#include "pore_motion.hpp"

#include <algorithm>

#include "grid/blocks.hpp"
#include "grid/momentum.hpp"

namespace geodrop {

template <int Dim>
PoreMotion<Dim>::PoreMotion(Grid<Dim>& grains, Grid<Dim>& water, double dt)
    : dt_(dt),
      bagged_(grains.outline.size() > 0),
      grains_{&grains, {}, {}, {}, {}},
      water_{&water, {}, {}, {}, {}},
      known_(water.layout.nodes(), false) {
  find_nodes();
  for (Field* field : {&grains_, &water_}) {
    for (std::vector<double>& component : field->change) component.assign(water.layout.nodes(), 0.0);
    if (bagged_) find_shares(*field);
  }
}

template <int Dim>
void PoreMotion<Dim>::find_nodes() {
  const Grid<Dim>&water = *water_.grid, &grains = *grains_.grid;
  const auto inverse = [](double mass) { return mass > 0 ? 1 / mass : 0.0; };
  const auto find_in_row = [&](int begin, int count, const std::array<int, Dim>&) {
    for (int flat = begin; flat < begin + count; ++flat) {
      const double m_w = water.sum[flat][3], m_s = grains.sum[flat][3];
      if (!(m_w > 0) && !(m_s > 0)) continue;
      Node node{flat, m_w > 0 || bagged_ ? water.pore_share[flat] : 1.0, inverse(m_w), inverse(m_s), 0, {}, false};
      const double drag = m_w > 0 && m_s > 0 ? dt_ * water.node_drag[flat] : 0;
      node.drag = drag / (1 + drag * (node.of_water + node.of_grains));
      node.held = held_by_walls(water.layout, flat);
      nodes_.push_back(node);
      known_[flat] = true;
    }
  };
  for (const std::uint32_t block : water.active_blocks) for_each_real_row_of_block(water.layout, block, find_in_row);
}

template <int Dim>
void PoreMotion<Dim>::find_shares(Field& field) {
  field.light.assign(field.grid->layout.nodes(), false);
  for (const Node& node : nodes_) {
    const std::size_t before = field.shares.size();
    for_shares_of_impulse<Dim>(*field.grid, node.flat, [&](int to, double share) {
      if (known_[to]) field.shares.push_back({node.flat, to, share});
    });
    const bool keeps_all =
        field.shares.size() == before + 1 && field.shares.back().to == node.flat && field.shares.back().share == 1;
    if (keeps_all)
      field.shares.pop_back();
    else
      field.light[node.flat] = true;
  }
}

/// Impulses of light nodes to where they go.
template <int Dim>
void PoreMotion<Dim>::hand_on(Field& field, int component) {
  if (field.shares.empty()) return;
  std::vector<double>& impulse = field.change[component];
  std::vector<double>& given = field.given;
  given.clear();
  for (const Share& share : field.shares) given.push_back(share.share * impulse[share.from]);
  for (const Share& share : field.shares) impulse[share.from] = 0;
  for (std::size_t k = 0; k < given.size(); ++k) impulse[field.shares[k].to] += given[k];
}

/// Adds the part of a field to the velocities that cells see; velocity(node) is that of the field.
template <int Dim>
template <class F>
void PoreMotion<Dim>::add_seen(int component, const Field& field, F&& velocity, std::vector<double>& out) const {
  const bool of_water = &field == &water_;
  const auto part = [&](const Node& node) { return of_water ? node.share : 1 - node.share; };
  std::size_t s = 0;  // shares stand in the order of the nodes
  for (const Node& node : nodes_) {
    double seen = 0;
    if (field.light.empty() || !field.light[node.flat]) {
      seen = velocity(node.flat);
    } else {
      for (; s < field.shares.size() && field.shares[s].from == node.flat; ++s)
        seen += field.shares[s].share * velocity(field.shares[s].to);
    }
    if (!node.held[component]) out[node.flat] += part(node) * seen;
  }
}

template <int Dim>
void PoreMotion<Dim>::begin(const std::vector<bool>& pressed) {
  for (Node& node : nodes_) node.pressed = pressed[node.flat];
}

template <int Dim>
double PoreMotion<Dim>::lightness(int node) const {
  const Grid<Dim>&water = *water_.grid, &grains = *grains_.grid;
  const double least = light_mass<Dim>(water, stored_cell(water.layout, node));
  const auto about = [&](double share, double mass) { return mass > 0 ? share * share / std::max(mass, least) : 0.0; };
  const double n = water.pore_share[node];
  return about(n, water.sum[node][3]) + about(1 - n, grains.sum[node][3]);
}

template <int Dim>
void PoreMotion<Dim>::respond(NodeVectors<Dim>& impulse) {
  for (int a = 0; a < Dim; ++a) {
    std::vector<double>&w = water_.change[a], &s = grains_.change[a];
    for (const Node& node : nodes_) {
      const double f = node.pressed ? impulse[a][node.flat] : 0;
      w[node.flat] = node.share * f;
      s[node.flat] = (1 - node.share) * f;
    }
    hand_on(water_, a);
    hand_on(grains_, a);
    for (const Node& node : nodes_) {
      double& v_w = w[node.flat];
      double& v_s = s[node.flat];
      v_w *= node.held[a] ? 0 : node.of_water;
      v_s *= node.held[a] ? 0 : node.of_grains;
      const double exchanged = node.drag * (v_w - v_s);
      v_w -= exchanged * node.of_water;
      v_s += exchanged * node.of_grains;
      impulse[a][node.flat] = 0;
    }
    add_seen(
        a, water_, [&](int node) { return w[node]; }, impulse[a]);
    add_seen(
        a, grains_, [&](int node) { return s[node]; }, impulse[a]);
  }
}

template <int Dim>
void PoreMotion<Dim>::velocities(NodeVectors<Dim>& out) const {
  for (int a = 0; a < Dim; ++a) {
    for (const Node& node : nodes_) out[a][node.flat] = 0;
    add_seen(
        a, water_, [&](int node) { return water_.grid->velocity[node][a]; }, out[a]);
    add_seen(
        a, grains_, [&](int node) { return grains_.grid->velocity[node][a]; }, out[a]);
  }
}

template <int Dim>
void PoreMotion<Dim>::move() {
  for (Field* field : {&water_, &grains_})
    for (const Node& node : nodes_)
      for (int a = 0; a < Dim; ++a) {
        field->grid->velocity[node.flat][a] += field->change[a][node.flat];
        if (!field->grid->velocity_change.empty())
          field->grid->velocity_change[node.flat][a] += field->change[a][node.flat];
      }
  impose_wall_velocity(*grains_.grid);  // that of the water follows
}

template class PoreMotion<2>;
template class PoreMotion<3>;

}  // namespace geodrop
