// Vectors at nodes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace geodrop {

/// A vector at a node, given by its flat index.
template <int Dim>
struct NodeVector {
  int node;
  std::array<double, Dim> value;
};

/// Vectors at the nodes of a grid, one array for each component, by flat index.
template <int Dim>
using NodeVectors = std::array<std::vector<double>, Dim>;

/// Adds up what is at the same node, in the order given; then sorted by node.
template <int Dim>
void add_up_by_node(std::vector<NodeVector<Dim>>& vectors) {
  if (vectors.empty()) return;
  std::stable_sort(vectors.begin(), vectors.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
  std::size_t kept = 0;
  for (std::size_t k = 1; k < vectors.size(); ++k)
    if (vectors[k].node == vectors[kept].node)
      for (int a = 0; a < Dim; ++a) vectors[kept].value[a] += vectors[k].value[a];
    else
      vectors[++kept] = vectors[k];
  vectors.resize(kept + 1);
}

}  // namespace geodrop
