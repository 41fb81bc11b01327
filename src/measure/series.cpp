#include "series.hpp"

#include <cmath>
#include <limits>

namespace geodrop {
namespace {

constexpr double not_told = std::numeric_limits<double>::quiet_NaN();

/// Time at which the straight line between rows i and i+1 reaches `level`.
double crossing(const Series& series, std::size_t i, double level) {
  const double part = (level - series.value[i]) / (series.value[i + 1] - series.value[i]);
  return series.t[i] + part * (series.t[i + 1] - series.t[i]);
}

/// Numerator and denominator of the slope of a straight line through times over 0, 1, 2, ...
struct SlopeSums {
  double numerator = 0, denominator = 0;

  void add(const std::vector<double>& times) {
    const double centre = (static_cast<double>(times.size()) - 1) / 2;
    for (std::size_t k = 0; k < times.size(); ++k) {
      numerator += (static_cast<double>(k) - centre) * times[k];
      denominator += (static_cast<double>(k) - centre) * (static_cast<double>(k) - centre);
    }
  }
};

/// Value at time t; NaN outside the rows.
double interpolate(const Series& series, double t) {
  // A row may come up to one rounding error after the time it was due at.
  constexpr double rounding = 1e-9;
  for (std::size_t i = 0; i < series.t.size(); ++i) {
    if (std::abs(t - series.t[i]) <= rounding * std::abs(t)) return series.value[i];
    if (i + 1 == series.t.size() || t < series.t[i] || t > series.t[i + 1]) continue;
    const double part = (t - series.t[i]) / (series.t[i + 1] - series.t[i]);
    return series.value[i] + part * (series.value[i + 1] - series.value[i]);
  }
  return not_told;
}

}  // namespace

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double period(const Series& series) {
  std::vector<double> rising, falling;
  for (std::size_t i = 0; i + 1 < series.t.size(); ++i) {
    const bool below = series.value[i] < 0, below_next = series.value[i + 1] < 0;
    if (below == below_next) continue;
    (below ? rising : falling).push_back(crossing(series, i, 0));
  }
  SlopeSums sums;
  sums.add(rising);
  sums.add(falling);
  return sums.denominator > 0 ? sums.numerator / sums.denominator : not_told;
}

double first_time_below(const Series& series, double level) {
  for (std::size_t i = 0; i < series.t.size(); ++i) {
    if (series.value[i] >= level) continue;
    return i == 0 ? series.t[i] : crossing(series, i - 1, level);
  }
  return not_told;
}

double rms_difference(const Series& series, const std::vector<double>& times, const std::vector<double>& values) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < times.size(); ++i) differences.push_back(interpolate(series, times[i]) - values.at(i));
  return rms(differences);
}

double slope(const Series& series) {
  const double t_mean = mean(series.t), mean_value = mean(series.value);
  double tt = 0, tv = 0;
  for (std::size_t i = 0; i < series.t.size(); ++i) {
    tt += (series.t[i] - t_mean) * (series.t[i] - t_mean);
    tv += (series.t[i] - t_mean) * (series.value[i] - mean_value);
  }
  return tt > 0 ? tv / tt : not_told;
}

Moments moments_of(const std::vector<double>& x, const std::vector<double>& y) {
  const double x_mean = mean(x), y_mean = mean(y);
  Moments sums;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sums.xx += (x[i] - x_mean) * (x[i] - x_mean);
    sums.yy += (y[i] - y_mean) * (y[i] - y_mean);
    sums.xy += (x[i] - x_mean) * (y[i] - y_mean);
  }
  return sums;
}

double r_squared(const Series& a, const Series& b) {
  std::vector<double> x, y;
  for (std::size_t i = 0, j = 0; i < a.t.size() && j < b.t.size();) {
    if (a.t[i] == b.t[j]) {
      x.push_back(a.value[i]);
      y.push_back(b.value[j]);
    }
    const bool step_a = a.t[i] <= b.t[j], step_b = b.t[j] <= a.t[i];
    i += step_a;
    j += step_b;
  }
  const auto [xx, yy, xy] = moments_of(x, y);
  return xx > 0 && yy > 0 ? xy * xy / (xx * yy) : not_told;
}

}  // namespace geodrop
