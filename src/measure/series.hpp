// What can be read off a series of values over time. NaN wherever the series does not tell.
#pragma once

#include <vector>

namespace geodrop {

/// Values at rising times [s], as many as there are times.
struct Series {
  std::vector<double> t, value;
};

double mean(const std::vector<double>& values);
double rms(const std::vector<double>& values);

/// Mean time between crossings of zero in the same direction [s]: the common slope of two straight lines, one through
/// the rising crossings over their number, one through the falling, so that an offset of the series does not matter.
double period(const Series& series);

/// First time at which the series is below the level, linear between rows [s].
double first_time_below(const Series& series, double level);

/// Root of the mean of (series(times_i) - values_i)^2, the series linear between rows.
double rms_difference(const Series& series, const std::vector<double>& times, const std::vector<double>& values);

/// Sums of squares and products about the means, of as many values each.
struct Moments {
  double xx = 0, yy = 0, xy = 0;
};
Moments moments_of(const std::vector<double>& x, const std::vector<double>& y);

/// Square of Pearson's correlation of two series at their common times: 1 if one is a straight line of the other.
double r_squared(const Series& a, const Series& b);

/// Slope of the straight line with the least sum of squared differences [1/s].
double slope(const Series& series);

}  // namespace geodrop
