// Small scenes whose features are chosen at random, as text, and their images: mirrored, turned, moved, with bodies in
// another order, with other units of mass. The same seed draws the same scene whatever the image (compilers may differ:
// they choose in which order operands are drawn).
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace geodrop::test {

using Pair = std::array<double, 2>;

/// What is done to a scene: x' = turn x + shift, all masses times `mass`, lists in reverse. `turn` takes axes to axes.
struct Image {
  std::array<int, 4> turn{1, 0, 0, 1};  ///< row-major
  std::array<int, 2> cells{0, 0};       ///< shift
  double mass = 1;
  bool reversed = false;

  Pair vector(const Pair& v) const { return {turn[0] * v[0] + turn[1] * v[1], turn[2] * v[0] + turn[3] * v[1]}; }
  bool turns() const { return turn != std::array{1, 0, 0, 1}; }
  int determinant() const { return turn[0] * turn[3] - turn[1] * turn[2]; }
};

/// R L R^T of two matrices, row-major.
inline std::array<double, 4> turn_tensor(const std::array<int, 4>& R, const std::array<double, 4>& L) {
  std::array<double, 4> out{};
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      for (int c = 0; c < 2; ++c)
        for (int d = 0; d < 2; ++d) out[2 * a + b] += R[2 * a + c] * L[2 * c + d] * R[2 * b + d];
  return out;
}

/// Writes the scene of a seed, seen through an image, as TOML.
class RandomScene {
 public:
  RandomScene(unsigned seed, const Image& image) : engine_(seed), image_(image) { draw(); }

  std::string text() const;
  double h() const { return h_; }
  Pair shift() const { return {image_.cells[0] * h_, image_.cells[1] * h_}; }
  int steps() const { return steps_; }
  const std::set<std::string>& features() const { return features_; }
  bool has(const std::string& feature) const { return features_.count(feature) != 0; }

 private:
  using Tables = std::vector<std::string>;

  double uniform(double low, double high) { return low + (high - low) * (engine_() / 4294967296.0); }
  bool chance(double share) { return uniform(0, 1) < share; }
  template <class T>
  T pick(const std::vector<T>& of) {
    return of[static_cast<std::size_t>(uniform(0, 1) * static_cast<double>(of.size()))];
  }
  /// Notes a feature of the scene.
  std::string with(const std::string& feature) {
    features_.insert(feature);
    return feature;
  }

  static std::string number(double value) {
    char out[32];
    std::snprintf(out, sizeof out, "%.17g", value);
    const std::string text = out;
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
  }
  static std::string pair(const Pair& v) { return "[" + number(v[0]) + ", " + number(v[1]) + "]"; }
  /// A quantity in proportion to mass.
  std::string mass(double value) const { return number(image_.mass * value); }
  std::string vector(const Pair& v) const { return pair(image_.vector(v)); }
  Pair moved(const Pair& x) const {
    const Pair y = image_.vector(x);
    return {y[0] + shift()[0], y[1] + shift()[1]};
  }
  std::string point(const Pair& x) const { return pair(moved(x)); }
  std::string points(const std::vector<Pair>& list) const;
  std::string box(const Pair& lower, const Pair& upper, bool braces) const;

  /// What a body is made of.
  struct Matter {
    bool fluid;
    std::string pressure;
  };

  void draw();
  void draw_solver();
  void draw_walls();
  std::string draw_fluid();
  std::string draw_shear();
  std::string draw_soil();
  std::string draw_elastic(const std::string& model);
  Matter draw_matter(const std::string& name, bool fluid);
  void draw_body(const std::string& name, const std::string& shape, const Matter& matter);
  std::string draw_ellipse(const Pair& centre, double size);
  std::string draw_polygon(const Pair& centre, double size);
  void draw_block(const std::string& name, const Pair& centre, double size);
  void draw_pool();
  void draw_contact(const std::string& one, const std::string& other);
  void draw_rigid(const Pair& centre, double size);
  void draw_extras();

  std::mt19937 engine_;
  Image image_;
  double h_ = 0.125;
  int steps_ = 0;
  Pair upper_{};  ///< of the domain before the image; the lower corner is the origin
  std::string head_, mass_matrix_, grid_, walls_, zone_;
  Tables materials_, bodies_, membranes_, rigid_, contacts_, more_;
  bool periodic_ = false, enclosed_ = false, sharp_ = false, immersed_ = false, sticks_ = false;
  std::string basis_, transfer_;
  std::string minus_;
  std::vector<std::string> touching_;
  std::set<std::string> features_;
};

}  // namespace geodrop::test
