#include "fill_particles.hpp"

#include <algorithm>
#include <cmath>
#include <geodrop/error.hpp>
#include <geodrop/shapes.hpp>
#include <random>

namespace geodrop {
namespace {

/// Cut sites are sampled by this many points per axis: the area of a site is then known to about 1 %, its sum over an
/// outline far better.
constexpr int samples_per_axis = 16;
/// Smaller shares are left out: they would be single points with next to no mass.
constexpr double smallest_share = 0.02;

/// The material points that belong to a body: inside its shape, outside all shapes cut out of it.
class BodyRegion {
 public:
  BodyRegion(const Scene& scene, const BodySpec& spec) : shape_(&spec.shape) {
    for (const std::string& name : spec.minus)
      for (const BodySpec& other : scene.bodies)
        if (other.name == name) removed_.push_back(&other.shape);
  }
  bool holds(const Point& x) const {
    return contains(*shape_, x) &&
           std::none_of(removed_.begin(), removed_.end(), [&](const Shape* s) { return contains(*s, x); });
  }

 private:
  const Shape* shape_;
  std::vector<const Shape*> removed_;
};

/// Share of a site inside the region, and the centroid of that share.
struct SiteShare {
  double share = 0;
  Point centroid;
};

/// Calls f(offset) for n^Dim points evenly spread over a site of width `width` around its centre.
template <int Dim, class F>
void for_each_sample(int n, double width, F&& f) {
  std::array<double, Dim> offset;
  int total = 1;
  for (int a = 0; a < Dim; ++a) total *= n;
  for (int k = 0; k < total; ++k) {
    for (int a = 0, rest = k; a < Dim; ++a, rest /= n) offset[a] = ((rest % n + 0.5) / n - 0.5) * width;
    f(offset);
  }
}

template <int Dim>
SiteShare sample_site(const BodyRegion& region, const Point& centre, double width, int n) {
  SiteShare out{0, Point(Dim, 0.0)};
  Point x(Dim);
  int inside = 0, total = 0;
  for_each_sample<Dim>(n, width, [&](const std::array<double, Dim>& offset) {
    for (int a = 0; a < Dim; ++a) x[a] = centre[a] + offset[a];
    ++total;
    if (!region.holds(x)) return;
    ++inside;
    for (int a = 0; a < Dim; ++a) out.centroid[a] += x[a];
  });
  out.share = static_cast<double>(inside) / total;
  if (inside > 0)
    for (double& c : out.centroid) c /= inside;
  return out;
}

template <int Dim>
SiteShare share_of_site(const BodyRegion& region, const Point& centre, double width) {
  constexpr int coarse = 4;
  SiteShare rough = sample_site<Dim>(region, centre, width, coarse);
  if (rough.share == 1) return {1, centre};
  return rough.share == 0 ? rough : sample_site<Dim>(region, centre, width, samples_per_axis);
}

/// Uniform in [-1, 1), the same on every platform (std::uniform_real_distribution is not).
double symmetric_random(std::mt19937_64& generator) {
  constexpr double scale = 1.0 / (1ULL << 53);
  return 2 * (static_cast<double>(generator() >> 11) * scale) - 1;
}

template <int Dim>
void add_particle(Body<Dim>& body, const Point& x, double volume) {
  body.id.push_back(static_cast<std::uint32_t>(body.id.size()));
  body.J.push_back(volume);
  for (int a = 0; a < Dim; ++a) body.x[a].push_back(x[a]);
}

template <int Dim>
void number_layers(Body<Dim>& body, int layers) {
  const auto& height = body.x[1];
  const auto [low, high] = std::minmax_element(height.begin(), height.end());
  const double bottom = *low, extent = std::max(*high - *low, 1e-300);
  body.layer.resize(height.size());
  for (std::size_t p = 0; p < height.size(); ++p)
    body.layer[p] =
        static_cast<std::uint8_t>(std::min(layers - 1, static_cast<int>((height[p] - bottom) / extent * layers)));
}

}  // namespace

template <int Dim>
void fill_particles(const Scene& scene, const BodySpec& spec, Body<Dim>& body) {
  const BodyRegion region(scene, spec);
  const double width = scene.grid.spacing / spec.particles_per_cell_axis;
  const double site_volume = std::pow(width, Dim);
  std::mt19937_64 generator(spec.jitter_seed);
  std::array<int, Dim> first, count;
  int total = 1;
  const Bounds box = bounds(spec.shape);
  for (int a = 0; a < Dim; ++a) {
    const double low = std::max(box.lower[a], scene.grid.lower[a]), high = std::min(box.upper[a], scene.grid.upper[a]);
    first[a] = static_cast<int>(std::floor((low - scene.grid.lower[a]) / width + 1e-9));
    count[a] = static_cast<int>(std::ceil((high - scene.grid.lower[a]) / width - 1e-9)) - first[a];
    total *= std::max(0, count[a]);
  }
  Point centre(Dim);
  for (int site = 0; site < total; ++site) {
    for (int a = 0, rest = site; a < Dim; rest /= count[a], ++a)
      centre[a] = scene.grid.lower[a] + (first[a] + rest % count[a] + 0.5) * width;
    SiteShare part = share_of_site<Dim>(region, centre, width);
    if (part.share < smallest_share) continue;
    if (spec.jitter > 0)
      for (double& c : part.centroid) c += spec.jitter * width * symmetric_random(generator);
    add_particle(body, part.centroid, part.share * site_volume);
  }
  if (body.J.empty())
    throw SceneError(scene.file, {{spec.at, "bodies." + spec.name + ".shape", "a shape without particles",
                                   "a shape wider than a particle spacing"}});
  number_layers(body, spec.layers);
}

template void fill_particles<2>(const Scene&, const BodySpec&, Body<2>&);
template void fill_particles<3>(const Scene&, const BodySpec&, Body<3>&);

}  // namespace geodrop
