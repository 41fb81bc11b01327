#include "even_out_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "held_nodes.hpp"
#include "outline.hpp"

namespace geodrop {
namespace {

double length_of(const LinePart& part, const Membrane<2>& membrane) {
  double sum = 0;
  for (std::size_t s = part.first; s < part.first + part.count; ++s)
    sum += segment_length(membrane, s % membrane.segments());
  return sum;
}

/// Running sums from 0, one more than values.
template <class F>
std::vector<double> running_sums(std::size_t count, F value) {
  std::vector<double> sums(count + 1, 0.0);
  for (std::size_t i = 0; i < count; ++i) sums[i + 1] = sums[i] + value(i);
  return sums;
}

/// A place on the old line: a share of the way along a segment.
struct OnLine {
  std::size_t segment;
  double share;
};

bool is_held(std::size_t node, const std::vector<std::size_t>& held) {
  return std::find(held.begin(), held.end(), node) != held.end();
}

/// The cubic through the ends of a segment with the slopes of the chords between their neighbours; at held nodes, where
/// the line may have a kink, that of the segment's own chord.
double cubic(const Membrane<2>& old, const Array<double>& x, const std::vector<double>& along, const OnLine& at,
             const std::vector<std::size_t>& held) {
  const auto width = [&](std::size_t s) { return along[s + 1] - along[s]; };
  const std::size_t s = at.segment, start = s, end = end_of_edge(s, old.nodes());
  const std::size_t before = is_held(start, held) ? start : node_before(old, start);
  const std::size_t after = is_held(end, held) ? end : node_after(old, end);
  const double d = width(s);
  const double below = before == start ? d : d + width(s == 0 ? old.segments() - 1 : s - 1);
  const double above = after == end ? d : d + width(end);
  const double slope_start = (x[end] - x[before]) * d / below, slope_end = (x[after] - x[start]) * d / above;
  const double u = at.share, v = 1 - u;
  return (1 + 2 * u) * v * v * x[start] + u * v * v * slope_start + u * u * (3 - 2 * u) * x[end] -
         u * u * v * slope_end;
}

/// All nodes but held ones along their normals, the same way, until the area is as given.
void restore_area(double area, const std::vector<std::size_t>& held, Membrane<2>& membrane) {
  constexpr int rounds = 3;  // Newton; the area is a quadratic function of a way that is small
  auto& [x, y] = membrane.x;
  const std::size_t n = membrane.nodes();
  for (int round = 0; round < rounds; ++round) {
    double rate = 0;  // of the area with the way
    for (std::size_t k = 0; k < n; ++k) {
      if (is_held(k, held)) continue;
      const std::size_t to = node_after(membrane, k), from = node_before(membrane, k);
      rate += 0.5 * std::hypot(x[to] - x[from], y[to] - y[from]);
    }
    const double way = (area - signed_area(x, y)) / rate;
    const std::array<Array<double>, 2> old = membrane.x;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t to = node_after(membrane, k), from = node_before(membrane, k);
      const double dx = old[0][to] - old[0][from], dy = old[1][to] - old[1][from], length = std::hypot(dx, dy);
      if (!(length > 0) || is_held(k, held)) continue;
      x[k] += way * dy / length;
      y[k] -= way * dx / length;
    }
  }
}

std::array<double, 2> momentum_of(const Membrane<2>& membrane) {
  std::array<double, 2> sum{};
  for (int a = 0; a < 2; ++a)
    for (std::size_t k = 0; k < membrane.nodes(); ++k) sum[a] += membrane.mass[k] * membrane.v[a][k];
  return sum;
}

void restore_momentum(const std::array<double, 2>& momentum, Membrane<2>& membrane) {
  const double mass = std::accumulate(membrane.mass.begin(), membrane.mass.end(), 0.0);
  if (!(mass > 0)) return;
  const std::array<double, 2> now = momentum_of(membrane);
  for (int a = 0; a < 2; ++a)
    for (double& v : membrane.v[a]) v += (momentum[a] - now[a]) / mass;
}

/// The parts of the line that keep their ends: all of it, from its first node, or what is between held nodes; if the
/// line is closed its first node is one of these.
std::vector<LinePart> parts_of(const Membrane<2>& membrane, const std::vector<std::size_t>& held) {
  if (held.empty()) return {{0, membrane.segments()}};
  return parts_between(held, membrane);
}

/// Share of a part in the length of the line at the start; of all of it 1, whatever rounding makes of the sum.
double share_of(const LinePart& part, const Membrane<2>& membrane) {
  if (part.count == membrane.segments()) return 1;
  double share = 0;
  for (std::size_t s = part.first; s < part.first + part.count; ++s) share += membrane.share[s % membrane.segments()];
  return share;
}

/// Where the nodes belong on the line, by their shares of the length of their part.
std::vector<OnLine> places(const Membrane<2>& membrane, const std::vector<LinePart>& parts,
                           const std::vector<double>& along) {
  std::vector<OnLine> places;
  std::size_t s = 0;
  for (const LinePart& part : parts) {
    const double whole = share_of(part, membrane), begin = along[part.first];
    const double length = along[part.first + part.count] - begin;
    double share = 0;
    for (std::size_t k = part.first; k < part.first + part.count; ++k) {
      const double target = begin + std::min(share / whole, 1.0) * length;
      while (s + 1 < membrane.segments() && along[s + 1] <= target) ++s;
      const double width = along[s + 1] - along[s];
      places.push_back({s, width > 0 ? std::clamp((target - along[s]) / width, 0.0, 1.0) : 0.0});
      share += membrane.share[k];
    }
  }
  if (!membrane.closed) places.push_back({membrane.segments() - 1, 1.0});
  return places;
}

/// Numbers nodes and segments of a closed line from another node on.
void begin_at(std::size_t first, Membrane<2>& membrane) {
  for (Array<double>* values : {&membrane.x[0], &membrane.x[1], &membrane.v[0], &membrane.v[1], &membrane.mass,
                                &membrane.rest_length, &membrane.share})
    std::rotate(values->begin(), values->begin() + static_cast<std::ptrdiff_t>(first), values->end());
}

}  // namespace

bool is_uneven(const Membrane<2>& membrane, const std::vector<std::size_t>& held) {
  for (const LinePart& part : parts_of(membrane, held)) {
    const double length = length_of(part, membrane) / share_of(part, membrane);
    for (std::size_t k = part.first; k < part.first + part.count; ++k) {
      const std::size_t s = k % membrane.segments();
      const double share = segment_length(membrane, s) / (length * membrane.share[s]);
      if (share < 0.5 || share > 2) return true;
    }
  }
  return false;
}

void even_out_nodes(Membrane<2>& membrane, std::vector<std::size_t> held) {
  const std::size_t first = membrane.closed && !held.empty() ? held.front() : 0;
  begin_at(first, membrane);
  for (std::size_t& node : held) node -= first;
  const Membrane<2> old = membrane;
  const std::size_t n = membrane.segments();
  const std::vector<double> along = running_sums(n, [&](std::size_t s) { return segment_length(old, s); });
  const std::vector<double> rest = running_sums(n, [&](std::size_t s) { return old.rest_length[s]; });
  const std::vector<OnLine> at = places(old, parts_of(old, held), along);
  const auto rest_at = [&](std::size_t k) {
    return k == at.size() ? rest[n] : rest[at[k].segment] + at[k].share * old.rest_length[at[k].segment];
  };
  for (std::size_t k = 0; k < membrane.nodes(); ++k)
    for (int a = 0; a < 2; ++a) {
      membrane.x[a][k] = cubic(old, old.x[a], along, at[k], held);
      const std::size_t start = at[k].segment, end = end_of_edge(start, old.nodes());
      membrane.v[a][k] = (1 - at[k].share) * old.v[a][start] + at[k].share * old.v[a][end];
    }
  for (std::size_t s = 0; s < n; ++s) membrane.rest_length[s] = rest_at(s + 1) - rest_at(s);
  share_mass(membrane);
  restore_momentum(momentum_of(old), membrane);
  if (membrane.closed) restore_area(signed_area(old.x[0], old.x[1]), held, membrane);
  if (first > 0) begin_at(membrane.nodes() - first, membrane);
}

void even_out_membranes(State<2>& state) {
  for (Membrane<2>& membrane : state.membranes) {
    if (!membrane.slides() || membrane.field == waiting) continue;
    const std::vector<std::size_t> held = held_nodes(state, membrane);
    if (!is_uneven(membrane, held)) continue;
    even_out_nodes(membrane, held);
    state.drift = -1;
  }
}

}  // namespace geodrop
