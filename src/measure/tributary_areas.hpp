// The length of line or area of surface that belongs to each node of a membrane, as in loads on its nodes.
#pragma once

#include <geodrop/state/state.hpp>

#include <vector>

namespace geodrop {

template <int Dim>
class TributaryAreas;

/// The line of a membrane in the plane, cut up among its nodes: half of the segments beside each. Of an open line the
/// left side is outside, and its ends have no piece. Values are those of segments.
template <>
class TributaryAreas<2> {
 public:
  explicit TributaryAreas(const Membrane<2>& membrane);

  std::size_t nodes() const { return size_.size(); }
  double size(std::size_t k) const { return size_[k]; }              ///< [m]
  const Vec<2>& normal(std::size_t k) const { return normal_[k]; }   ///< outwards, a unit vector
  double mean(const Array<double>& values, std::size_t k) const;     ///< of what is beside a node
  double largest(const Array<double>& values, std::size_t k) const;  ///< likewise
  /// Nodes from `k` on, to both sides, until half of the width [m] has passed.
  std::vector<std::size_t> about(std::size_t k, double width) const;

 private:
  const Membrane<2>& membrane_;
  std::vector<double> size_;
  std::vector<Vec<2>> normal_;
};

/// The triangles of a membrane in space, likewise: a third of those that meet at each node, their mean normal, and as
/// its size [m2] what of their area faces that way. Values are those of triangles.
template <>
class TributaryAreas<3> {
 public:
  explicit TributaryAreas(const Membrane<3>& membrane);

  std::size_t nodes() const { return size_.size(); }
  double size(std::size_t k) const { return size_[k]; }
  const Vec<3>& normal(std::size_t k) const { return normal_[k]; }
  double mean(const Array<double>& values, std::size_t k) const;
  double largest(const Array<double>& values, std::size_t k) const;
  /// Nodes within half of the width [m] of node `k`, as far as triangles lead from one to the next.
  std::vector<std::size_t> about(std::size_t k, double width) const;

 private:
  const Membrane<3>& membrane_;
  std::vector<double> size_;
  std::vector<Vec<3>> normal_;
  std::vector<std::vector<std::uint32_t>> triangles_;  ///< of each node
};

}  // namespace geodrop
