#include "pore_motion.hpp"

#include <algorithm>

#include "grid/blocks.hpp"
#include "grid/momentum.hpp"

namespace geodrop {

template <int Dim>
PoreMotion<Dim>::PoreMotion(Grid<Dim>& grains, Grid<Dim>& water, double dt)
    : dt_(dt),
      bagged_(grains.outline.size() > 0 || (water.field == 0 && !water.taken.empty())),
      grains_{&grains, {}, {}, {}, {}},
      water_{&water, {}, {}, {}, {}},
      number_(water.layout.nodes(), -1) {
  find_nodes();
  for (Field* field : {&grains_, &water_}) {
    field->change.assign(nodes_.size(), Vec4{});
    field->light.assign(nodes_.size(), 0);
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
      const std::array<bool, Dim> held = held_by_walls(water.layout, flat);
      for (int a = 0; a < Dim; ++a) node.free[a] = held[a] ? 0 : 1;
      number_[flat] = static_cast<int>(nodes_.size());
      nodes_.push_back(node);
    }
  };
  for (const std::uint32_t block : water.active_blocks) for_each_real_row_of_block(water.layout, block, find_in_row);
}

template <int Dim>
void PoreMotion<Dim>::find_shares(Field& field) {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const int from = static_cast<int>(k);
    const std::size_t before = field.shares.size();
    for_shares_of_impulse<Dim>(*field.grid, nodes_[k].flat, [&](int to, double share) {
      if (number_[to] >= 0) field.shares.push_back({from, number_[to], share});
    });
    const bool keeps_all =
        field.shares.size() == before + 1 && field.shares.back().to == from && field.shares.back().share == 1;
    if (keeps_all)
      field.shares.pop_back();
    else
      field.light[k] = 1;
  }
}

/// Impulses of light nodes to where they go.
template <int Dim>
void PoreMotion<Dim>::hand_on(Field& field) {
  std::vector<Vec4>&impulse = field.change, &given = field.given;
  given.clear();
  for (const Share& share : field.shares) given.push_back(share.share * impulse[share.from]);
  for (const Share& share : field.shares) impulse[share.from] = Vec4{};
  for (std::size_t k = 0; k < given.size(); ++k) impulse[field.shares[k].to] += given[k];
}

/// Writes the velocities that cells see; those of the two fields by number of their nodes.
template <int Dim>
void PoreMotion<Dim>::see(auto&& of_water, auto&& of_grains, NodeVectors<Dim>& out) const {
  auto water_share = water_.shares.begin(), grains_share = grains_.shares.begin();  // in the order of the nodes
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto seen = [k](const Field& field, auto&& velocity, auto& share) {
      if (!field.light[k]) return velocity(k);
      Vec4 sum{};
      for (; share != field.shares.end() && share->from == static_cast<int>(k); ++share)
        sum += share->share * velocity(share->to);
      return sum;
    };
    const Node& node = nodes_[k];
    const Vec4 v =
        node.share * seen(water_, of_water, water_share) + (1 - node.share) * seen(grains_, of_grains, grains_share);
    for (int a = 0; a < Dim; ++a) out[a][node.flat] = node.free[a] > 0 ? v[a] : 0;
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
  std::vector<Vec4>&w = water_.change, &s = grains_.change;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Node& node = nodes_[k];
    Vec4 f{};
    for (int a = 0; a < Dim && node.pressed; ++a) f[a] = impulse[a][node.flat];
    w[k] = node.share * f;
    s[k] = (1 - node.share) * f;
  }
  hand_on(water_);
  hand_on(grains_);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Node& node = nodes_[k];
    w[k] *= node.of_water * node.free;
    s[k] *= node.of_grains * node.free;
    const Vec4 exchanged = node.drag * (w[k] - s[k]);
    w[k] -= exchanged * node.of_water;
    s[k] += exchanged * node.of_grains;
  }
  see([&](std::size_t k) { return w[k]; }, [&](std::size_t k) { return s[k]; }, impulse);
}

template <int Dim>
void PoreMotion<Dim>::velocities(NodeVectors<Dim>& out) const {
  see([&](std::size_t k) { return water_.grid->velocity[nodes_[k].flat]; },
      [&](std::size_t k) { return grains_.grid->velocity[nodes_[k].flat]; }, out);
}

template <int Dim>
void PoreMotion<Dim>::move() {
  for (Field* field : {&water_, &grains_})
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      for (int a = 0; a < Dim; ++a) {
        field->grid->velocity[nodes_[k].flat][a] += field->change[k][a];
        if (!field->grid->velocity_change.empty())
          field->grid->velocity_change[nodes_[k].flat][a] += field->change[k][a];
      }
  impose_wall_velocity(*grains_.grid);  // that of the water follows
}

template class PoreMotion<2>;
template class PoreMotion<3>;

}  // namespace geodrop
