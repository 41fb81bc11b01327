// Mean and standard deviation of weighted values.
#pragma once

#include <algorithm>
#include <cmath>

namespace geodrop {

/// NaN before there is a weight.
struct MeanAndDeviation {
  double weight = 0, sum = 0, squares = 0;
  void add(double w, double value) {
    weight += w;
    sum += w * value;
    squares += w * value * value;
  }
  double mean() const { return sum / weight; }
  double deviation() const { return std::sqrt(std::max(0.0, squares / weight - mean() * mean())); }
};

}  // namespace geodrop
