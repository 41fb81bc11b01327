#include "body_force.hpp"

#include "../kernels/kernels.hpp"
#include "../kernels/slabs.hpp"

namespace geodrop {

template <int Dim>
std::vector<DrivenBody> driven_bodies(const Scene& scene) {
  std::vector<DrivenBody> driven;
  for (const ExactSpec& spec : scene.exact)
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      if (scene.bodies[b].name != spec.body || !std::holds_alternative<AxisAlignedMmsSpec>(spec.solution)) continue;
      driven.push_back({b, std::get<AxisAlignedMms>(exact_solution<Dim>(scene, spec.body))});
    }
  return driven;
}

template <int Dim>
void body_force_to_grid(const std::vector<DrivenBody>& driven, const State<Dim>& state, Grid<Dim>& grid,
                        const StepContext& step) {
  const bool separate = !grid.force.empty();
  for (const DrivenBody& one : driven) {
    const Body<Dim>& body = state.bodies[one.body];
    if (body.field != grid.field) continue;
    const auto n = static_cast<std::ptrdiff_t>(body.size());
    std::array<Array<double>, Dim> force;
    for (auto& component : force) component.resize(body.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t p = 0; p < n; ++p) {
      const Vec<Dim> b = body_force<Dim>(one.mms, vector_at(body.initial_x, body.id[p]), step.t);
      for (int a = 0; a < Dim; ++a) force[a][p] = separate ? b[a] : step.dt * b[a];
    }
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
