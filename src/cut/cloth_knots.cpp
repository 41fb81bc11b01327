#include "cloth_knots.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "membrane/triangles.hpp"

namespace geodrop {
namespace {

/// Nodes of a membrane and the edges between them, as long as they are at rest.
class ClothGraph {
 public:
  explicit ClothGraph(const Membrane<3>& membrane) : edges_(membrane.nodes()), distance_(membrane.nodes(), far) {
    const auto& corner = membrane.triangles.corner;
    for (std::size_t t = 0; t < membrane.triangles.size(); ++t) {
      const Eigen::Matrix2d sides = rest_edges(membrane, t);
      add(corner[0][t], corner[1][t], sides.col(0).norm());
      add(corner[0][t], corner[2][t], sides.col(1).norm());
      add(corner[1][t], corner[2][t], (sides.col(1) - sides.col(0)).norm());
    }
  }

  /// f(node, distance from `from`) for the nodes that are closer than `most`, the nearest first (Dijkstra 1959).
  template <class F>
  void for_each_within(std::uint32_t from, double most, F&& f) {
    using Reached = std::pair<double, std::uint32_t>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
    std::vector<std::uint32_t> seen;
    const auto reach = [&](std::uint32_t node, double distance) {
      if (!(distance < most && distance < distance_[node])) return;
      if (distance_[node] == far) seen.push_back(node);
      distance_[node] = distance;
      front.emplace(distance, node);
    };
    reach(from, 0);
    while (!front.empty()) {
      const auto [distance, node] = front.top();
      front.pop();
      if (distance > distance_[node]) continue;  // reached on a shorter way since
      f(node, distance);
      for (const auto& [next, length] : edges_[node]) reach(next, distance + length);
    }
    for (const std::uint32_t node : seen) distance_[node] = far;
  }

 private:
  static constexpr double far = std::numeric_limits<double>::infinity();

  void add(std::uint32_t one, std::uint32_t other, double length) {
    edges_[one].emplace_back(other, length);
    edges_[other].emplace_back(one, length);
  }

  std::vector<std::vector<std::pair<std::uint32_t, double>>> edges_;
  std::vector<double> distance_;  ///< of the search that runs
};

/// In the order of nodes, each that no earlier one is close to.
std::vector<std::uint32_t> nodes_apart(ClothGraph& graph, std::size_t nodes, double least) {
  std::vector<bool> covered(nodes, false);
  std::vector<std::uint32_t> apart;
  for (std::uint32_t node = 0; node < nodes; ++node) {
    if (covered[node]) continue;
    apart.push_back(node);
    graph.for_each_within(node, least, [&](std::uint32_t near, double) { covered[near] = true; });
  }
  return apart;
}

}  // namespace

void add(int knot, double value, KnotShares& shares) {
  const auto found = std::find_if(shares.begin(), shares.end(), [&](const auto& share) { return share.knot == knot; });
  if (found != shares.end())
    found->value += value;
  else
    shares.push_back({knot, value});
}

ClothKnots cloth_knots(const Membrane<3>& membrane, double distance) {
  ClothGraph graph(membrane);
  const std::vector<std::uint32_t> knots = nodes_apart(graph, membrane.nodes(), 0.9 * distance);
  const double reach = 1.25 * distance;
  std::vector<KnotShares> of_node(membrane.nodes());
  for (std::size_t k = 0; k < knots.size(); ++k)
    graph.for_each_within(knots[k], reach, [&](std::uint32_t node, double way) {
      of_node[node].push_back({static_cast<int>(k), 1 - way / reach});
    });
  ClothKnots cloth{static_cast<int>(knots.size()), std::vector<KnotShares>(membrane.triangles.size())};
  for (KnotShares& shares : of_node) {
    double sum = 0;
    for (const KnotShare& share : shares) sum += share.value;
    for (KnotShare& share : shares) share.value /= sum;
  }
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t)
    for (const auto& corner : membrane.triangles.corner)
      for (const auto& [knot, value] : of_node[corner[t]]) add(knot, value / 3, cloth.of_triangle[t]);
  return cloth;
}

}  // namespace geodrop
