// The tension that is reported: a mean over a gauge length and a time, as in a wide-width strip test (EN ISO 10319).
#pragma once

#include <geodrop/state/state.hpp>

namespace geodrop {

inline constexpr double gauge_window = 1e-3;  ///< [s]
inline constexpr std::size_t gauge_windows = 10;
inline constexpr double gauge_time = gauge_windows * gauge_window;  ///< of the mean [s]

/// Slots of TensionGauge::sums: the windows of the mean and the running one.
inline constexpr std::size_t gauge_slots = gauge_windows + 1;

/// Adds the tensions of a step from `t` to `t + dt` [s]. At the end of each window of the run's time, `now` is the
/// largest mean over the gauge length and the ten latest windows: no interval of output enters.
template <int Dim>
void add_to_gauge(double t, double dt, Membrane<Dim>& membrane);

/// After a report: the peak counts from the present value on.
template <int Dim>
void restart_peak(TensionGauge<Dim>& gauge);

/// The largest mean of `values` of segments over any stretch of the gauge length (rest length), and its middle. A line
/// that is shorter: its mean. In space the largest value of a triangle.
template <int Dim>
struct GaugeMean {
  double mean = 0;
  std::array<double, Dim> middle{};  ///< [m]
};
template <int Dim>
GaugeMean<Dim> largest_gauge_mean(const Membrane<Dim>& membrane, const Array<double>& values);

}  // namespace geodrop
