#include "slide.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace geodrop {
namespace {

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
  tension.resize(segments);
  for (std::vector<double>* values : {&friction, &drag, &load, &passed}) values->assign(nodes(), 0.0);
}

/// What passes where the tension grows by `step` at a node: what friction does not hold, against the drag.
double ClothSlide::passes(std::size_t k, double step) const {
  const double pull = step + cloth_->load[k], beyond = std::abs(pull) - cloth_->friction[k];
  return beyond > 0 ? std::copysign(beyond, pull) * lightness_[k] : 0.0;
}

/// q, and the gradient: rest length that a segment has less the one that its tension asks for. Returns the largest of
/// segments that are taut or ought to be, over what counts as none: a share of the length, and what q loses by
/// rounding.
double ClothSlide::find_gradient(const std::vector<double>& tension) {
  constexpr double converged = 1e-12, rounding = 4e-16;
  Cloth& cloth = *cloth_;
  const std::size_t n = cloth.segments();
  cloth.passed.front() = cloth.closed ? passes(0, tension[0] - tension[n - 1]) : 0.0;
  for (std::size_t k = 1; k < n; ++k) cloth.passed[k] = passes(k, tension[k] - tension[k - 1]);
  double largest = 0;
  for (std::size_t s = 0; s < n; ++s) {
    const std::size_t end = node_ahead(cloth, s);
    const double asked = cloth.stiffness * cloth.length[s] / (cloth.stiffness + tension[s]);
    gradient_[s] = (cloth.rest[s] - asked) + (cloth.passed[s] - cloth.passed[end]);
    if (slack(tension[s], gradient_[s])) continue;
    const double lightest = std::max(lightness_[s], lightness_[end]);
    largest =
        std::max(largest, std::abs(gradient_[s]) / (converged * cloth.length[s] + rounding * tension[s] * lightest));
  }
  return largest;
}

/// Newton's direction for the tensions of segments that do not stay slack replaces `right_`.
void ClothSlide::find_direction() {
  const Cloth& cloth = *cloth_;
  const std::size_t n = cloth.segments();
  const auto holds = [&](std::size_t k) { return cloth.passed[k] != 0 ? lightness_[k] : 0.0; };
  const double next_to_none = 1e-6 * cloth.stiffness;  // such tensions fall to 0 at once where they have to fall
  const auto stays = [&](std::size_t s) { return tension_[s] <= next_to_none && gradient_[s] >= 0; };
  for (std::size_t s = 0; s < n; ++s) {
    const std::size_t behind = s == 0 ? n - 1 : s - 1, ahead = s + 1 == n ? 0 : s + 1;
    lower_[s] = upper_[s] = 0;
    diagonal_[s] = 1;
    right_[s] = -tension_[s];
    if (stays(s)) continue;
    const double stretched = cloth.stiffness + tension_[s], below = holds(s), above = holds(node_ahead(cloth, s));
    diagonal_[s] = cloth.stiffness * cloth.length[s] / (stretched * stretched) + below + above;
    right_[s] = -gradient_[s];
    if (!stays(behind)) lower_[s] = -below;
    if (!stays(ahead)) upper_[s] = -above;
  }
  solve_tridiagonal();
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

/// Along the direction as far as the energy falls, which is convex: where it still falls there, or the gradient is less
/// than ever. Leaves q and the gradient there; returns its largest.
double ClothSlide::advance(double least_gradient) {
  constexpr double least_part = 1e-6;
  const auto falls = [&] {
    double rate = 0;
    for (std::size_t s = 0; s < tension_.size(); ++s) rate += gradient_[s] * (trial_[s] - tension_[s]);
    return rate < 0;
  };
  for (double part = 1;; part /= 2) {
    for (std::size_t s = 0; s < tension_.size(); ++s) trial_[s] = std::max(0.0, tension_[s] + part * right_[s]);
    const double now = find_gradient(trial_);
    if (!(now < 0.9 * least_gradient) && !falls() && part > least_part) continue;
    tension_.swap(trial_);
    return now;
  }
}

/// With so much more drag; that of the cloth alone to the end, else as far as the next start needs.
bool ClothSlide::descend(double softening, int rounds) {
  constexpr double start_for_less = 1e8;
  const Cloth& cloth = *cloth_;
  const double enough = softening > 1 ? start_for_less : 1;
  for (std::size_t k = 0; k < cloth.nodes(); ++k) lightness_[k] = 1 / (softening * cloth.drag[k]);
  double now = find_gradient(tension_), least = now;
  for (int round = 0; round < rounds && now >= enough; ++round) {
    find_direction();
    now = advance(least);
    least = std::min(least, now);
  }
  return now < enough;
}

bool ClothSlide::solve(Cloth& cloth) {
  constexpr int few_rounds = 2, some_rounds = 60;
  cloth_ = &cloth;
  const std::size_t n = cloth.segments();
  for (std::vector<double>* values : {&trial_, &gradient_, &lower_, &diagonal_, &upper_, &right_, &corner_, &factor_})
    values->resize(n);
  lightness_.resize(cloth.nodes());
  cloth.passed.back() = 0;  // of an open line: nothing passes its ends
  tension_ = cloth.tension;
  bool done = descend(1, few_rounds);
  if (!done) {
    for (const double softening : {100, 30, 10, 3}) descend(softening, some_rounds);
    done = descend(1, most_rounds);
  }
  if (!done) std::fill(cloth.passed.begin(), cloth.passed.end(), 0.0);
  for (std::size_t s = 0; s < n; ++s) cloth.rest[s] += cloth.passed[s] - cloth.passed[node_ahead(cloth, s)];
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
