#include "fill_particles.hpp"

#include <algorithm>
#include <cmath>
#include <geodrop/base/error.hpp>
#include <geodrop/geometry/shapes.hpp>
#include <numeric>
#include <random>
#include <unordered_map>

#include "lattice.hpp"
#include "site_share.hpp"

namespace geodrop {
namespace {

/// Smaller shares get no particle of their own, but swell that of a neighbour: they would be points with next to no
/// mass.
constexpr double smallest_share = 0.02;

/// A share of the body that becomes one particle.
template <int Dim>
struct Portion {
  std::int64_t site;
  SiteShare<Dim> part;
};

template <int Dim>
double distance2(const std::array<double, Dim>& a, const std::array<double, Dim>& b) {
  double sum = 0;
  for (int axis = 0; axis < Dim; ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return sum;
}

template <int Dim>
void merge(SiteShare<Dim>& into, const SiteShare<Dim>& from) {
  const double share = into.share + from.share;
  for (int a = 0; a < Dim; ++a)
    into.centroid[a] = (into.share * into.centroid[a] + from.share * from.centroid[a]) / share;
  into.share = share;
}

/// Hands each small share to the nearest portion among those of the sites around; what is farther off follows through
/// the small share between. A body of small shares alone keeps none.
template <int Dim>
void hand_over(const Lattice<Dim>& lattice, std::vector<Portion<Dim>> small, std::vector<Portion<Dim>>& portions) {
  if (small.empty()) return;
  std::unordered_map<std::int64_t, std::size_t> owner;
  for (std::size_t k = 0; k < portions.size(); ++k) owner.emplace(portions[k].site, k);
  for (std::size_t before = 0; before != small.size();) {
    before = small.size();
    std::erase_if(small, [&](const Portion<Dim>& crumb) {
      Portion<Dim>* nearest = nullptr;
      const auto gap = [&](const Portion<Dim>& p) { return distance2<Dim>(p.part.centroid, crumb.part.centroid); };
      lattice.for_each_neighbour(crumb.site, [&](std::int64_t site) {
        const auto found = owner.find(site);
        if (found == owner.end()) return;
        Portion<Dim>& portion = portions[found->second];
        if (!nearest || gap(portion) < gap(*nearest)) nearest = &portion;
      });
      if (!nearest) return false;
      SiteShare<Dim> part = crumb.part;
      part.share *= lattice.volume(crumb.site) / lattice.volume(nearest->site);
      merge(nearest->part, part);
      owner.emplace(crumb.site, static_cast<std::size_t>(nearest - portions.data()));
      return true;
    });
  }
}

/// Most sites are far from any outline: whole blocks of them are inside or outside, and only the others are looked at
/// one by one (1.6 million sites of water around an ellipsoid: 9 s without blocks).
template <int Dim>
std::vector<Cover> block_covers(const Lattice<Dim>& lattice, const BodyRegion& region) {
  std::vector<Cover> covers(static_cast<std::size_t>(lattice.blocks()));
  for (std::size_t b = 0; b < covers.size(); ++b)
    covers[b] = region.cover(lattice.block_box(static_cast<std::int64_t>(b)));
  return covers;
}

template <int Dim>
std::vector<Portion<Dim>> divide(const Lattice<Dim>& lattice, const BodyRegion& region) {
  std::vector<Portion<Dim>> portions, small;
  const std::vector<Cover> covers = block_covers(lattice, region);
  Bounds site{Point(Dim), Point(Dim)};
  for (std::int64_t k = 0; k < lattice.size(); ++k) {
    const Cover block = covers[static_cast<std::size_t>(lattice.block_of(k))];
    if (block == Cover::none) continue;
    lattice.get_site(k, site);
    const SiteShare<Dim> part = block == Cover::all ? whole_site<Dim>(site) : region.share<Dim>(site);
    if (part.share > 0) (part.share < smallest_share ? small : portions).push_back({k, part});
  }
  hand_over(lattice, std::move(small), portions);
  return portions;
}

/// Uniform in [-1, 1), the same on every platform (std::uniform_real_distribution is not).
double symmetric_random(std::mt19937_64& generator) {
  constexpr double scale = 1.0 / (1ULL << 53);
  return 2 * (static_cast<double>(generator() >> 11) * scale) - 1;
}

/// Moves particles at random. One that would leave its site or its body, as that of a cut site may, is moved by a half,
/// a quarter, ... of that, or not at all.
template <int Dim>
void jitter(const Lattice<Dim>& lattice, const BodyRegion& region, const BodySpec& spec,
            std::vector<Portion<Dim>>& portions) {
  constexpr int halvings = 5;
  std::mt19937_64 generator(spec.jitter_seed);
  Bounds site{Point(Dim), Point(Dim)};
  for (Portion<Dim>& portion : portions) {
    std::array<double, Dim> offset = lattice.widths(portion.site);
    for (double& c : offset) c = spec.jitter * c * symmetric_random(generator);
    auto& at = portion.part.centroid;
    Point x(Dim);
    for (int a = 0; a < Dim; ++a) x[a] = at[a] + offset[a];
    if (portion.part.share != 1) {
      lattice.get_site(portion.site, site);
      const BoxShape box{site.lower, site.upper};
      int halved = 0;
      for (; halved < halvings && !(contains(box, x) && region.holds(x)); ++halved)
        for (int a = 0; a < Dim; ++a) x[a] = at[a] + (offset[a] /= 2);
      if (halved == halvings) continue;
    }
    std::copy(x.begin(), x.end(), at.begin());
  }
}

template <int Dim>
void number_layers(Body<Dim>& body, int layers) {
  const auto& height = body.x[vertical_axis<Dim>];
  const auto [low, high] = std::minmax_element(height.begin(), height.end());
  const double bottom = *low, extent = std::max(*high - *low, 1e-300);
  body.layer.resize(height.size());
  for (std::size_t p = 0; p < height.size(); ++p)
    body.layer[p] =
        static_cast<std::uint8_t>(std::min(layers - 1, static_cast<int>((height[p] - bottom) / extent * layers)));
}

template <int Dim>
bool any_particle(const Scene& scene, const BodySpec& spec) {
  const Lattice<Dim> lattice(scene, spec);
  const BodyRegion region(scene, spec);
  Bounds site{Point(Dim), Point(Dim)};
  for (std::int64_t k = 0; k < lattice.size(); ++k) {
    lattice.get_site(k, site);
    if (region.share<Dim>(site).share >= smallest_share) return true;
  }
  return false;
}

}  // namespace

bool has_particles(const Scene& scene, const BodySpec& spec) {
  return scene.dimension == 2 ? any_particle<2>(scene, spec) : any_particle<3>(scene, spec);
}

template <int Dim>
void fill_particles(const Scene& scene, const BodySpec& spec, Body<Dim>& body) {
  const BodyRegion region(scene, spec);
  const Lattice<Dim> lattice(scene, spec);
  std::vector<Portion<Dim>> portions = divide(lattice, region);
  if (portions.empty())
    throw SceneError(scene.file, {{spec.at, "bodies." + spec.name + ".shape", "a shape without particles",
                                   "a shape that fills 2 % of a particle's site somewhere"}});
  if (spec.jitter > 0) jitter(lattice, region, spec, portions);
  const std::size_t n = portions.size();
  body.id.resize(n);
  std::iota(body.id.begin(), body.id.end(), 0u);
  body.J.resize(n);
  for (auto& component : body.x) component.resize(n);
  for (std::size_t p = 0; p < n; ++p) {
    body.J[p] = portions[p].part.share * lattice.volume(portions[p].site);
    for (int a = 0; a < Dim; ++a) body.x[a][p] = portions[p].part.centroid[a];
  }
  number_layers(body, spec.layers);
}

template void fill_particles<2>(const Scene&, const BodySpec&, Body<2>&);
template void fill_particles<3>(const Scene&, const BodySpec&, Body<3>&);

}  // namespace geodrop
