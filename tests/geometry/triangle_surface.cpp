// Closed triangulated surfaces: generators, faults, volumes of boxes that they cut.
#include <doctest/doctest.h>
#include <geodrop/geometry/triangle_surface.hpp>

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/surface_file.hpp"
#include "geometry/surface_generators.hpp"
#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double pi = std::numbers::pi;

/// Sums of the boxes of a lattice over the box around a surface.
struct Sums {
  double volume = 0, least = 0, most = 0;
  Corner first{};
};
Sums sum_of_boxes(const SurfaceRegion& region, double width) {
  Sums sums;
  std::array<int, 3> count;
  for (std::size_t a = 0; a < 3; ++a)
    count[a] = static_cast<int>(std::ceil((region.upper()[a] - region.lower()[a]) / width)) + 1;
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        const Corner low{region.lower()[0] + (i - 0.5) * width, region.lower()[1] + (j - 0.5) * width,
                         region.lower()[2] + (k - 0.5) * width};
        const auto part = region.moments_in(low, {low[0] + width, low[1] + width, low[2] + width});
        sums.volume += part.volume;
        sums.least = std::min(sums.least, part.volume / std::pow(width, 3));
        sums.most = std::max(sums.most, part.volume / std::pow(width, 3));
        for (std::size_t a = 0; a < 3; ++a) sums.first[a] += part.first[a];
      }
  return sums;
}

}  // namespace

TEST_CASE("Generated surfaces are closed, face outwards and enclose what their shapes do") {
  // Chords of e on a radius R cut off about e^2 / (8 R^2) to either side.
  const TriangleSurface ball = ellipsoid_surface({1, 2, 3}, {1, 1, 1}, 0.1);
  CHECK(fault_of(ball).empty());
  CHECK(volume(ball) == near(4 * pi / 3, 5e-3));
  CHECK(area(ball) == near(4 * pi, 3e-3));
  const TriangleSurface egg = ellipsoid_surface({0, 0, 0}, {2, 1, 0.5}, 0.1);
  CHECK(fault_of(egg).empty());
  CHECK(volume(egg) == near(4 * pi / 3, 5e-3));
  const TriangleSurface capsule = capsule_surface({0, 0, 0}, {3, 4, 0}, 1, 0.1);
  CHECK(fault_of(capsule).empty());
  CHECK(volume(capsule) == near(5 * pi + 4 * pi / 3, 5e-3));
  CHECK(area(capsule) == near(10 * pi + 4 * pi, 3e-3));
  const TriangleSurface pillow = pillow_surface({0, 0, 1}, 4, 2, 0.3, 0.1);
  CHECK(fault_of(pillow).empty());
  CHECK(volume(pillow) == near(0.3 * 4 * 2 * 4.0 / 9, 0.02));  // thin: parabolas, (int of 1 - u^2)^2 / 4 = 4/9
  CHECK(pillow.unstretched.size() == pillow.points.size());
  const TriangleSurface disc = disc_pillow_surface({0, 0, 0}, 1, 0.4, 0.05);
  CHECK(fault_of(disc).empty());
  // Two caps of the sphere of radius 1 / a, (1 - cos a) / a = 0.2: a = 0.4055.
  const double a = 0.406, cap = pi * 0.04 * (3 / a - 0.2) / 3;
  CHECK(volume(disc) == near(2 * cap, 5e-3));
}

TEST_CASE("Edges of generated surfaces are about as long as asked for") {
  for (const double edge : {0.05, 0.2}) {
    CAPTURE(edge);
    for (const TriangleSurface& surface :
         {ellipsoid_surface({0, 0, 0}, {1, 1, 1}, edge), capsule_surface({0, 0, 0}, {2, 0, 0}, 1, edge)}) {
      const double mean = std::sqrt(area(surface) / static_cast<double>(surface.triangles.size()) * 4 / std::sqrt(3.0));
      CHECK(mean == near(edge, 0.12));
    }
  }
}

TEST_CASE("A fault of a surface names the triangle") {
  const TriangleSurface ball = ellipsoid_surface({0, 0, 0}, {1, 1, 1}, 0.5);
  const auto fault_with = [&](auto change) {
    TriangleSurface broken = ball;
    change(broken);
    return fault_of(broken);
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(has(fault_with([](TriangleSurface& s) { s.triangles.pop_back(); }), "an edge without a neighbour"));
  CHECK(has(fault_with([](TriangleSurface& s) { std::swap(s.triangles[6][0], s.triangles[6][1]); }), "triangle 7"));
  CHECK(has(fault_with([](TriangleSurface& s) { s.triangles[4][2] = s.triangles[4][1]; }),
            "triangle 5, which has no area"));
  CHECK(has(fault_with([](TriangleSurface& s) { s.triangles[2][0] = 100000; }), "triangle 3, which has a corner"));
  CHECK(has(fault_with([](TriangleSurface& s) {
              for (auto& t : s.triangles) std::swap(t[0], t[1]);
            }),
            "face inwards"));
}

TEST_CASE("The parts of the boxes of a lattice inside of a surface add up to its volume and centre, to round-off") {
  // Also where corners lie on the planes of the lattice, and where the surface cuts itself.
  TriangleSurface rounded = ellipsoid_surface({0.1, 0.2, 0.3}, {1, 1, 1}, 0.15), torn = rounded;
  for (Corner& x : rounded.points)
    for (double& c : x) c = std::round(8 * c) / 8;
  std::mt19937_64 generator(7);
  for (Corner& x : torn.points)
    for (double& c : x) c += 0.1 * (static_cast<double>(generator() >> 11) / (1ULL << 53) - 0.5);
  for (const TriangleSurface& surface : {ellipsoid_surface({0.1, 0.2, 0.3}, {1, 1, 1}, 0.15), rounded, torn}) {
    const SurfaceRegion region(surface);
    const Sums sums = sum_of_boxes(region, 0.25);
    CHECK(sums.volume == near(volume(surface), 1e-14));
  }
  const SurfaceRegion ball(ellipsoid_surface({0.1, 0.2, 0.3}, {1, 1, 1}, 0.15));
  const Sums sums = sum_of_boxes(ball, 0.25);
  CHECK(sums.least >= -1e-14);
  CHECK(sums.most <= 1 + 1e-14);
  for (std::size_t a = 0; a < 3; ++a) CHECK(sums.first[a] / sums.volume == near((a + 1) * 0.1, 1e-3));
}

TEST_CASE("Moments of a box that a tetrahedron cuts off are those by hand") {
  TriangleSurface corner{
      {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {}};
  REQUIRE(fault_of(corner).empty());
  const SurfaceRegion region(corner);
  // The cube [0,1]^3 is inside as a whole; of [1,2] x [0,1]^2 the part x + y + z > 3, a tetrahedron of 1/6, is not.
  CHECK(region.moments_in({0, 0, 0}, {1, 1, 1}).volume == near(1.0, 1e-14));
  const auto part = region.moments_in({1, 0, 0}, {2, 1, 1});
  CHECK(part.volume == near(5.0 / 6, 1e-14));
  // Less the moments of that tetrahedron: its centre of mass is 1/4 from the corner (2, 1, 1).
  CHECK(part.first[0] == near(1.5 - 1.75 / 6, 1e-14));
  CHECK(part.first[1] == near(0.5 - 0.75 / 6, 1e-14));
  CHECK(part.first[2] == near(0.5 - 0.75 / 6, 1e-14));
}

TEST_CASE("Points are inside or outside as the shape says") {
  const SurfaceRegion ball(ellipsoid_surface({0, 0, 0}, {1, 1, 1}, 0.1));
  std::mt19937_64 generator(3);
  const auto random = [&] { return 2.4 * (static_cast<double>(generator() >> 11) / (1ULL << 53) - 0.5); };
  for (int k = 0; k < 1000; ++k) {
    const Corner x{random(), random(), random()};
    const double r = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    if (std::abs(r - 1) < 0.01) continue;
    CHECK(ball.contains(x) == (r < 1));
  }
  CHECK(ball.contains({0, 0, 0}));  // in line with corners and edges
}

TEST_CASE("A tetrahedron is the same from STL text, from STL binary and from OBJ") {
  const std::array<Corner, 4> x{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const std::array<std::array<int, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  std::string text = "solid s\n", binary(80, ' '), obj = "# a corner\n";
  const std::uint32_t count = 4;
  binary.append(reinterpret_cast<const char*>(&count), sizeof count);
  for (const Corner& c : x)
    obj += "v " + std::to_string(c[0]) + ' ' + std::to_string(c[1]) + ' ' + std::to_string(c[2]) + '\n';
  for (const auto& face : faces) {
    text += "facet normal 0 0 0\nouter loop\n";
    binary.append(12, '\0');
    obj += 'f';
    for (const int k : face) {
      const Corner& c = x[static_cast<std::size_t>(k)];
      text += "vertex " + std::to_string(c[0]) + ' ' + std::to_string(c[1]) + ' ' + std::to_string(c[2]) + '\n';
      for (const double number : c) {
        const auto single = static_cast<float>(number);
        binary.append(reinterpret_cast<const char*>(&single), sizeof single);
      }
      obj += ' ' + std::to_string(k + 1) + "//1";
    }
    text += "endloop\nendfacet\n";
    binary.append(2, '\0');
    obj += '\n';
  }
  for (const SurfaceFromFile& file : {parse_stl(text), parse_stl(binary), parse_obj(obj)}) {
    CHECK(file.fault.empty());
    CHECK(file.surface.points.size() == 4);
    CHECK(fault_of(file.surface).empty());
    CHECK(volume(file.surface) == near(1.0 / 6, 1e-14));
  }
  CHECK(parse_obj("v 0 0 0\nf 1 2 3\n").fault == "a corner that is not there, 2 in line 2");
  CHECK(parse_stl("solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nendloop").fault ==
        "a vertex without three numbers in facet 1");
}
