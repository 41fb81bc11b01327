#include "tributary_areas.hpp"

#include <algorithm>

#include "membrane/fluid_load.hpp"
#include "membrane/outline.hpp"
#include "membrane/triangles.hpp"

namespace geodrop {

TributaryAreas<2>::TributaryAreas(const Membrane<2>& membrane) : membrane_(membrane) {
  const double sense = membrane.closed ? sense_of(membrane) : 1;
  for (std::size_t k = 0; k < membrane.nodes(); ++k) {
    const bool end = !membrane.closed && (k == 0 || k == membrane.segments());
    const auto [tx, ty] = tangent_at(membrane, k);
    normal_.push_back({sense * ty, -sense * tx});
    size_.push_back(end ? 0 : 0.5 * (segment_length(membrane, k) + segment_length(membrane, node_before(membrane, k))));
  }
}

double TributaryAreas<2>::mean(const Array<double>& values, std::size_t k) const {
  return 0.5 * (values[k] + values[node_before(membrane_, k)]);
}

double TributaryAreas<2>::largest(const Array<double>& values, std::size_t k) const {
  return std::max(values[std::min(k, membrane_.segments() - 1)], values[node_before(membrane_, k)]);
}

std::vector<std::size_t> TributaryAreas<2>::about(std::size_t k, double width) const {
  std::vector<std::size_t> found{k};
  for (const auto& next : {node_before, node_after}) {
    double way = size_[k] / 2;
    for (std::size_t at = next(membrane_, k); way < width / 2 && at != k; at = next(membrane_, at)) {
      if (at == next(membrane_, at) || found.size() > nodes() / 2) break;  // an end, or round
      found.push_back(at);
      way += size_[at];
    }
  }
  return found;
}

TributaryAreas<3>::TributaryAreas(const Membrane<3>& membrane)
    : membrane_(membrane),
      size_(membrane.nodes()),
      normal_(membrane.nodes(), Vec<3>::Zero()),
      triangles_(membrane.nodes()) {
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t)
    for (const Array<std::uint32_t>& corner : membrane.triangles.corner) {
      normal_[corner[t]] += normal_of(membrane, t) / 6;
      triangles_[corner[t]].push_back(static_cast<std::uint32_t>(t));
    }
  for (std::size_t k = 0; k < nodes(); ++k) {
    size_[k] = normal_[k].norm();
    if (size_[k] > 0) normal_[k] /= size_[k];
  }
}

double TributaryAreas<3>::mean(const Array<double>& values, std::size_t k) const {
  double sum = 0, area = 0;
  for (const std::uint32_t t : triangles_[k]) {
    const double part = normal_of(membrane_, t).norm();
    sum += part * values[t];
    area += part;
  }
  return area > 0 ? sum / area : 0;
}

double TributaryAreas<3>::largest(const Array<double>& values, std::size_t k) const {
  double largest = 0;
  for (const std::uint32_t t : triangles_[k]) largest = std::max(largest, values[t]);
  return largest;
}

std::vector<std::size_t> TributaryAreas<3>::about(std::size_t k, double width) const {
  const Vec<3> middle = vector_at(membrane_.x, k);
  std::vector<std::size_t> found{k};
  for (std::size_t next = 0; next < found.size(); ++next)
    for (const std::uint32_t t : triangles_[found[next]])
      for (const Array<std::uint32_t>& corner : membrane_.triangles.corner) {
        const std::size_t node = corner[t];
        if ((vector_at(membrane_.x, node) - middle).norm() > width / 2) continue;
        if (std::find(found.begin(), found.end(), node) == found.end()) found.push_back(node);
      }
  return found;
}

}  // namespace geodrop
