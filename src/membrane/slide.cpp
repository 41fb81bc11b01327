#include "slide.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace geodrop {
namespace {

constexpr double converged = 1e-13;        ///< change of q in a sweep over the length of a node
constexpr double most_of_a_segment = 0.9;  ///< of its rest length that may leave a segment in one step of a node

/// Nodes that rest length passes: all of a closed line, all but the ends of an open one.
struct Passable {
  std::size_t first, end;
};
Passable passable(const Cloth& cloth) {
  return cloth.closed ? Passable{0, cloth.nodes()} : Passable{1, cloth.segments()};
}

std::size_t segment_behind(const Cloth& cloth, std::size_t node) { return node == 0 ? cloth.segments() - 1 : node - 1; }
std::size_t node_ahead(const Cloth& cloth, std::size_t segment) {
  return cloth.closed && segment + 1 == cloth.segments() ? 0 : segment + 1;
}

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// Tension of segments over that of the first, as the loads at the nodes between them ask; closed: less their mean.
void accumulate_loads(const Cloth& cloth, std::vector<double>& steps) {
  const double mean = cloth.closed ? total(cloth.load) / total(cloth.length) : 0;  // per length
  double sum = 0;
  steps[0] = 0;
  for (std::size_t s = 1; s < cloth.segments(); ++s) {
    sum -= cloth.load[s] - mean * 0.5 * (cloth.length[s - 1] + cloth.length[s]);
    steps[s] = sum;
  }
}

}  // namespace

void Cloth::resize(std::size_t segments, bool as_closed) {
  closed = as_closed;
  length.resize(segments);
  rest.resize(segments);
  for (std::vector<double>* values : {&friction, &drag, &load, &passed}) values->assign(nodes(), 0.0);
}

double ClothSlide::tension(std::size_t s, double rest) const {
  return std::max(0.0, cloth_->stiffness * (cloth_->length[s] / rest - 1));
}

double ClothSlide::slope(std::size_t s, double rest) const {
  return cloth_->length[s] > rest ? cloth_->stiffness * cloth_->length[s] / (rest * rest) : 0.0;
}

double ClothSlide::energy(const std::vector<double>& passed) const {
  const Cloth& cloth = *cloth_;
  double sum = 0;
  for (std::size_t s = 0; s < cloth.segments(); ++s) {
    const double rest = old_[s] + passed[s] - passed[node_ahead(cloth, s)], length = cloth.length[s];
    if (rest <= (1 - most_of_a_segment) * std::min(cloth.rest[s], old_[s]))
      return std::numeric_limits<double>::infinity();
    if (rest < length) sum += cloth.stiffness * (rest - length + length * std::log(length / rest));
  }
  for (std::size_t k = 0; k < cloth.nodes(); ++k)
    sum += cloth.friction[k] * std::abs(passed[k]) + (0.5 * cloth.drag[k] * passed[k] - cloth.load[k]) * passed[k];
  return sum;
}

/// q of node k with all others held; the rest lengths beside it are those with q = 0.
double ClothSlide::node_minimum(std::size_t k, std::size_t behind, double rest_ahead, double rest_behind) const {
  constexpr int most_steps = 60;
  const Cloth& cloth = *cloth_;
  const double pull = tension(k, rest_ahead) - tension(behind, rest_behind) + cloth.load[k];
  if (std::abs(pull) <= cloth.friction[k]) return 0;
  const double force = cloth.load[k] + (pull > 0 ? -cloth.friction[k] : cloth.friction[k]);
  double low = pull > 0 ? 0 : -most_of_a_segment * rest_ahead, high = pull > 0 ? most_of_a_segment * rest_behind : 0;
  double now = std::clamp(cloth.passed[k], low, high);
  const double close = 1e-14 * (rest_ahead + rest_behind);
  for (int step = 0; step < most_steps && high - low > close; ++step) {
    const double value =
        tension(k, rest_ahead + now) - tension(behind, rest_behind - now) + force - cloth.drag[k] * now;
    (value > 0 ? low : high) = now;
    double next = now + value / (slope(k, rest_ahead + now) + slope(behind, rest_behind - now) + cloth.drag[k]);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double moved = std::abs(next - now);
    now = next;
    if (moved < close) break;
  }
  return now;
}

/// Node by node; returns the largest change of q over the length of a node.
double ClothSlide::sweep(bool forwards) {
  Cloth& cloth = *cloth_;
  const auto [first, end] = passable(cloth);
  double largest = 0;
  for (std::size_t i = first; i < end; ++i) {
    const std::size_t k = forwards ? i : end - 1 - (i - first), behind = segment_behind(cloth, k);
    const double rest_ahead = cloth.rest[k] - cloth.passed[k], rest_behind = cloth.rest[behind] + cloth.passed[k];
    const double now = node_minimum(k, behind, rest_ahead, rest_behind);
    largest = std::max(largest, std::abs(now - cloth.passed[k]) / (0.5 * (cloth.length[behind] + cloth.length[k])));
    cloth.rest[k] = rest_ahead + now;
    cloth.rest[behind] = rest_behind - now;
    cloth.passed[k] = now;
  }
  return largest;
}

/// Thomas algorithm with the Sherman-Morrison formula for the two corners; the solution replaces `right_`.
void ClothSlide::solve_tridiagonal() {
  const std::size_t n = diagonal_.size();
  const double last_first = upper_[n - 1], first_last = lower_[0], shift = -diagonal_[0];
  diagonal_[0] -= shift;
  diagonal_[n - 1] -= last_first * first_last / shift;
  std::fill(corner_.begin(), corner_.end(), 0.0);
  corner_[0] = shift;
  corner_[n - 1] = last_first;
  double pivot = diagonal_[0];
  right_[0] /= pivot;
  corner_[0] /= pivot;
  for (std::size_t k = 1; k < n; ++k) {
    factor_[k] = upper_[k - 1] / pivot;
    pivot = diagonal_[k] - lower_[k] * factor_[k];
    right_[k] = (right_[k] - lower_[k] * right_[k - 1]) / pivot;
    corner_[k] = (corner_[k] - lower_[k] * corner_[k - 1]) / pivot;
  }
  for (std::size_t k = n - 1; k-- > 0;) {
    right_[k] -= factor_[k + 1] * right_[k + 1];
    corner_[k] -= factor_[k + 1] * corner_[k + 1];
  }
  const double share =
      (right_[0] + first_last * right_[n - 1] / shift) / (1 + corner_[0] + first_last * corner_[n - 1] / shift);
  for (std::size_t k = 0; k < n; ++k) right_[k] -= share * corner_[k];
}

void ClothSlide::set_rest() {
  Cloth& cloth = *cloth_;
  for (std::size_t s = 0; s < cloth.segments(); ++s)
    cloth.rest[s] = old_[s] + (cloth.passed[s] - cloth.passed[node_ahead(cloth, s)]);
}

/// One step for all nodes that slide; a node that would slide back comes to rest.
void ClothSlide::newton() {
  Cloth& cloth = *cloth_;
  for (std::size_t k = 0; k < cloth.nodes(); ++k) {
    lower_[k] = upper_[k] = right_[k] = 0;
    diagonal_[k] = 1;
    if (cloth.passed[k] == 0) continue;
    const std::size_t behind = segment_behind(cloth, k);
    const double ahead_slope = slope(k, cloth.rest[k]), behind_slope = slope(behind, cloth.rest[behind]);
    if (ahead_slope + behind_slope + cloth.drag[k] == 0) continue;  // slack, and nothing holds it
    diagonal_[k] = ahead_slope + behind_slope + cloth.drag[k];
    lower_[k] = -behind_slope;
    upper_[k] = -ahead_slope;
    right_[k] = tension(k, cloth.rest[k]) - tension(behind, cloth.rest[behind]) + cloth.load[k] -
                std::copysign(cloth.friction[k], cloth.passed[k]) - cloth.drag[k] * cloth.passed[k];
  }
  solve_tridiagonal();
  const double before = energy(cloth.passed);
  for (double part = 1; part > 0.05; part /= 2) {
    for (std::size_t k = 0; k < cloth.nodes(); ++k) {
      trial_[k] = cloth.passed[k] + part * right_[k];
      if (trial_[k] * cloth.passed[k] < 0) trial_[k] = 0;
    }
    if (!(energy(trial_) < before)) continue;
    cloth.passed = trial_;
    set_rest();
    return;
  }
}

bool ClothSlide::solve(Cloth& cloth) {
  cloth_ = &cloth;
  old_ = cloth.rest;
  for (std::vector<double>* values : {&trial_, &lower_, &diagonal_, &upper_, &right_, &corner_, &factor_})
    values->resize(cloth.nodes());
  std::fill(cloth.passed.begin(), cloth.passed.end(), 0.0);
  bool done = false;
  for (int round = 0; round < most_rounds && !done; ++round) {
    const double forth = sweep(true);
    done = forth < converged || sweep(false) < converged;
    if (!done) newton();
  }
  set_rest();
  return done;
}

void slide_freely(Cloth& cloth) {
  const std::size_t n = cloth.segments();
  std::vector<double>& steps = cloth.passed;  // T - T_0 of segments at first
  accumulate_loads(cloth, steps);
  const double least = *std::min_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(n));
  const double rest = total(cloth.rest), J = cloth.stiffness;
  // Sum of L / (1 + T/J) = sum of rest lengths: falls and is convex in T_0, so that Newton's steps from below stay
  // below.
  double tension = -least, sum = 0, fall = 0;
  constexpr int most_steps = 100;
  for (int step = 0; step < most_steps; ++step) {
    sum = fall = 0;
    for (std::size_t s = 0; s < n; ++s) {
      const double stretch = 1 + (tension + steps[s]) / J, part = cloth.length[s] / stretch;
      sum += part;
      fall += part / (stretch * J);
    }
    const double change = (sum - rest) / fall;
    if (change <= 1e-14 * J) break;
    tension += change;
  }
  // What is left over lies where nothing is taut; what rounding leaves is shared by all.
  const bool slack = tension == -least && sum < rest;
  double loose = 0;
  for (std::size_t s = 0; s < n; ++s)
    if (steps[s] == least) loose += cloth.length[s];
  double ahead = 0;  // rest length that has passed the present node
  for (std::size_t s = 0; s < n; ++s) {
    double now = cloth.length[s] / (1 + (tension + steps[s]) / J);
    if (!slack)
      now *= rest / sum;
    else if (steps[s] == least)
      now += (rest - sum) * cloth.length[s] / loose;
    const double change = cloth.rest[s] - now;
    steps[s] = ahead;
    ahead += change;
    cloth.rest[s] = now;
  }
  if (!cloth.closed) {
    steps[n] = 0;
    return;
  }
  double mean = 0;
  for (std::size_t k = 0; k < n; ++k) mean += steps[k] / static_cast<double>(n);
  for (double& passed : steps) passed -= mean;  // the least sliding: the line does not turn as a whole
}

}  // namespace geodrop
