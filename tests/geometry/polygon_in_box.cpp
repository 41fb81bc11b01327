// What is known of a polygon in a box is what is known of the whole polygon, bit for bit.
#include "geometry/polygon_in_box.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace geodrop;

namespace {

/// Lobes with a rough outline, and corners on lines that boxes have as sides.
PolygonShape rough_polygon() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> roughness(-0.05, 0.05);
  PolygonShape polygon;
  constexpr int corners = 400;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, radius = 3 + std::sin(7 * angle) + roughness(random);
    polygon.points.push_back({4 + radius * std::cos(angle), 4 + radius * std::sin(angle)});
    if (i % 10 == 0)
      for (double& c : polygon.points.back()) c = std::round(4 * c) / 4;
  }
  return polygon;
}

/// What a row has within a box.
std::vector<Chord> within(const Bounds& box, const std::vector<Chord>& row) {
  std::vector<Chord> inside;
  for (const Chord& c : row) {
    const Chord part{std::max(c.from, box.lower[0]), std::min(c.to, box.upper[0])};
    if (part.to > part.from) inside.push_back(part);
  }
  return inside;
}

bool same(const std::vector<Chord>& a, const std::vector<Chord>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Chord& x, const Chord& y) { return x.from == y.from && x.to == y.to; });
}

template <class Visit>
void for_each_box(Visit visit) {
  for (const auto& [wide, high] : {std::pair{0.25, 0.25}, std::pair{1.0, 0.25}, std::pair{0.25, 2.0}})
    for (double x = 0; x < 8; x += wide)
      for (double y = 0; y < 8; y += high) visit(Bounds{{x, y}, {x + wide, y + high}});
}

}  // namespace

TEST_CASE("Rows in a box are those of the whole polygon") {
  const PolygonShape polygon = rough_polygon();
  const std::vector<PolygonEdge> edges = edges_of(polygon);
  std::size_t chords_seen = 0;
  for_each_box([&](const Bounds& box) {
    const PolygonInBox part(edges, box);
    for (const double share : {0.0, 0.1, 0.37, 0.5, 0.93, 1.0}) {
      const double y = box.lower[1] + share * (box.upper[1] - box.lower[1]);
      const std::vector<Chord> whole = within(box, chords(polygon, {box.lower[0], y}, 0));
      chords_seen += whole.size();
      CHECK(same(within(box, part.row(y)), whole));
    }
  });
  CHECK(chords_seen > 3000);
}

TEST_CASE("Whether a box is inside, outside or cut is what the whole outline says") {
  const PolygonShape polygon = rough_polygon();
  const std::vector<PolygonEdge> edges = edges_of(polygon);
  int cut = 0;
  for_each_box([&](const Bounds& box) {
    const PolygonInBox part(edges, box);
    const Point middle{(box.lower[0] + box.upper[0]) / 2, (box.lower[1] + box.upper[1]) / 2};
    const double radius = std::hypot(box.upper[0] - middle[0], box.upper[1] - middle[1]);
    const bool near = distance_to_outline(polygon, middle) <= radius;
    cut += near;
    CHECK(part.comes_near(middle, radius) == near);
    if (!near) CHECK(part.contains(middle) == contains(polygon, middle));
  });
  CHECK(cut > 100);
}

TEST_CASE("Levels in a box are those of corners and of crossings of its sides") {
  const PolygonShape polygon = rough_polygon();
  const std::vector<PolygonEdge> edges = edges_of(polygon);
  for_each_box([&](const Bounds& box) {
    std::vector<double> levels, expected;
    PolygonInBox(edges, box).add_levels(levels);
    for (const Point& corner : polygon.points) expected.push_back(corner[1]);
    for (const Point& side : {box.lower, box.upper})
      for (const Chord& chord : chords(polygon, side, 1)) expected.insert(expected.end(), {chord.from, chord.to});
    const auto inside = [&](std::vector<double>& list) {
      std::erase_if(list, [&](double y) { return y <= box.lower[1] || y >= box.upper[1]; });
      std::sort(list.begin(), list.end());
      return list;
    };
    CHECK((inside(levels) == inside(expected)));
  });
}
