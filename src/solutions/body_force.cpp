#include "body_force.hpp"

#include "transfer/kernels.hpp"
#include "transfer/slabs.hpp"

#include <type_traits>

namespace geodrop {

template <int Dim>
std::vector<DrivenBody> driven_bodies(const Scene& scene) {
  std::vector<DrivenBody> driven;
  for (const ExactSpec& spec : scene.exact)
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      if (scene.bodies[b].name != spec.body) continue;
      const ExactSolution<Dim> solution = exact_solution<Dim>(scene, spec.body);
      if (const auto* mms = std::get_if<AxisAlignedMms>(&solution)) driven.push_back({b, *mms});
      if (const auto* vortex = std::get_if<GeneralizedVortex>(&solution)) driven.push_back({b, *vortex});
      if (const auto* drop = std::get_if<OscillatingDrop>(&solution)) driven.push_back({b, *drop});
    }
  return driven;
}

namespace {

/// Whether a force depends on where a particle is, not on where it was.
template <class Solution>
constexpr bool by_place = std::is_same_v<Solution, OscillatingDrop>;

/// Force per mass of each particle times `factor`.
template <int Dim, class Solution>
void set_force(const Solution& solution, const Body<Dim>& body, double t, double factor,
               std::array<Array<double>, Dim>& force) {
  const auto n = static_cast<std::ptrdiff_t>(body.size());
  for (auto& component : force) component.resize(body.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t p = 0; p < n; ++p) {
    const Vec<Dim> at = by_place<Solution> ? vector_at(body.x, p) : vector_at(body.initial_x, body.id[p]);
    const Vec<Dim> b = body_force<Dim>(solution, at, t);
    for (int a = 0; a < Dim; ++a) force[a][p] = factor * b[a];
  }
}

}  // namespace

template <int Dim>
void body_force_to_grid(const std::vector<DrivenBody>& driven, const State<Dim>& state, Grid<Dim>& grid,
                        const StepContext& step) {
  const bool separate = !grid.force.empty();
  for (const DrivenBody& one : driven) {
    const Body<Dim>& body = state.bodies[one.body];
    if (body.field != grid.field) continue;
    std::array<Array<double>, Dim> force;
    std::visit([&](const auto& s) { set_force<Dim>(s, body, step.t, separate ? 1.0 : step.dt, force); }, one.solution);
    Vec4* const target = separate ? grid.force.data() : grid.sum.data();
    for_each_slab_by_colour(state, grid, [&](const Body<Dim>& other, std::size_t begin, std::size_t end) {
      if (&other == &body) sum_by_mass<Dim>(body, {pointers(force), 0.0}, grid.layout, target, begin, end);
    });
  }
}

#define GEODROP_INSTANTIATE(D)                                     \
  template std::vector<DrivenBody> driven_bodies<D>(const Scene&); \
  template void body_force_to_grid<D>(const std::vector<DrivenBody>&, const State<D>&, Grid<D>&, const StepContext&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
