#include "tension_gauge.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/polygon.hpp"
#include "triangles.hpp"

namespace geodrop {
namespace {

/// Rest length and the integral of values along it, at the nodes; twice round a closed line.
template <int Dim>
struct AlongLine {
  std::vector<double> rest{0.0}, integral{0.0};

  AlongLine(const Membrane<Dim>& membrane, const Array<double>& values) {
    const std::size_t n = membrane.segments();
    for (std::size_t s = 0; s < (membrane.closed ? 2 * n : n); ++s) {
      rest.push_back(rest.back() + membrane.rest_length[s % n]);
      integral.push_back(integral.back() + membrane.rest_length[s % n] * values[s % n]);
    }
  }
  /// The segment at a rest length along the line.
  std::size_t segment_at(double r) const {
    const auto above = std::upper_bound(rest.begin(), rest.end(), r);
    return std::min(rest.size() - 2, static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - rest.begin() - 1, 0)));
  }
  double share_at(std::size_t s, double r) const { return (r - rest[s]) / (rest[s + 1] - rest[s]); }
  double integral_to(double r) const {
    const std::size_t s = segment_at(r);
    return integral[s] + share_at(s, r) * (integral[s + 1] - integral[s]);
  }
};

/// Of the larger of the two tensions of each triangle: a triangle is as wide as a gauge, and there is no line.
GaugeMean<3> largest_of_triangles(const Membrane<3>& membrane, const Array<double>& values) {
  const auto largest = std::max_element(values.begin(), values.end());
  const Eigen::Vector3d at = middle_of(membrane, static_cast<std::size_t>(largest - values.begin()));
  return {*largest, {at[0], at[1], at[2]}};
}

template <int Dim>
std::size_t count_tensions(const Membrane<Dim>& membrane) {
  return membrane.tension.size();
}

template <int Dim>
double tension_of(const Membrane<Dim>& membrane, std::size_t s) {
  if constexpr (Dim == 3) return std::max(membrane.tension[s], membrane.triangles.cross_tension[s]);
  return membrane.tension[s];
}

template <int Dim>
void end_window(Membrane<Dim>& membrane) {
  TensionGauge<Dim>& gauge = membrane.gauge;
  const std::size_t n = count_tensions(membrane);
  ++gauge.windows;
  const std::size_t running = gauge.windows % gauge_slots;
  const auto slot = [&](std::size_t i) { return gauge.sums.begin() + static_cast<std::ptrdiff_t>(i * n); };
  std::fill(slot(running), slot(running + 1), 0.0);
  if (gauge.windows < gauge_windows) return;
  Array<double> mean(n, 0.0);
  for (std::size_t i = 0; i < gauge_slots; ++i)
    for (std::size_t s = 0; s < n; ++s) mean[s] += slot(i)[static_cast<std::ptrdiff_t>(s)] / gauge_time;
  const GaugeMean<Dim> largest = largest_gauge_mean(membrane, mean);
  gauge.now = largest.mean;
  gauge.now_at = largest.middle;
  if (gauge.now <= gauge.peak) return;
  gauge.peak = gauge.now;
  gauge.peak_at = gauge.now_at;
  gauge.peak_time = static_cast<double>(gauge.windows) * gauge_window;
}

}  // namespace

template <int Dim>
GaugeMean<Dim> largest_gauge_mean(const Membrane<Dim>& membrane, const Array<double>& values) {
  if constexpr (Dim == 3) return largest_of_triangles(membrane, values);
  const AlongLine<Dim> line(membrane, values);
  const std::size_t n = membrane.segments();
  const double whole = line.rest[n], gauge = std::min(membrane.gauge_length, whole);
  GaugeMean<Dim> best{-1, {}};
  double from = 0;
  // The mean is linear in the place while both ends stay in their segments: the largest has an end at a node.
  const auto try_from = [&](double start) {
    if (start < 0) start += membrane.closed ? whole : -start;
    if (!membrane.closed) start = std::min(start, whole - gauge);
    const double mean = (line.integral_to(start + gauge) - line.integral_to(start)) / gauge;
    if (mean > best.mean) best.mean = mean, from = start;
  };
  for (std::size_t k = 0; k < n; ++k) {
    try_from(line.rest[k]);
    try_from(line.rest[k + 1] - gauge);
  }
  const double middle = from + gauge / 2;
  const std::size_t s = line.segment_at(middle), start = s % n, end = end_of_edge(start, membrane.nodes());
  const double share = line.share_at(s, middle);
  for (int a = 0; a < Dim; ++a) best.middle[a] = (1 - share) * membrane.x[a][start] + share * membrane.x[a][end];
  return best;
}

template <int Dim>
void add_to_gauge(double t, double dt, Membrane<Dim>& membrane) {
  TensionGauge<Dim>& gauge = membrane.gauge;
  if (gauge.sums.empty()) return;
  const std::size_t n = count_tensions(membrane);
  const double end = t + dt;
  // A membrane of a later stage begins with windows without tension.
  const auto begun = static_cast<std::uint64_t>(t / gauge_window);
  if (begun > gauge.windows + 1) gauge.windows = begun;
  for (double from = t;;) {
    const double border = static_cast<double>(gauge.windows + 1) * gauge_window;
    const double part = std::max(0.0, std::min(end, border) - from);
    double* running = &gauge.sums[gauge.windows % gauge_slots * n];
    for (std::size_t s = 0; s < n; ++s) running[s] += part * tension_of(membrane, s);
    if (end < border) return;
    end_window(membrane);
    from = border;
  }
}

template <int Dim>
void restart_peak(TensionGauge<Dim>& gauge) {
  gauge.peak = gauge.now;
  gauge.peak_at = gauge.now_at;
  gauge.peak_time = static_cast<double>(gauge.windows) * gauge_window;
}

#define GEODROP_INSTANTIATE(D)                                                           \
  template GaugeMean<D> largest_gauge_mean<D>(const Membrane<D>&, const Array<double>&); \
  template void add_to_gauge<D>(double, double, Membrane<D>&);                           \
  template void restart_peak<D>(TensionGauge<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
