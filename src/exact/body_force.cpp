#include "body_force.hpp"

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
void apply_body_force(const std::vector<DrivenBody>& driven, State<Dim>& state, const StepContext& step) {
  for (const DrivenBody& one : driven) {
    Body<Dim>& body = state.bodies[one.body];
    const auto n = static_cast<std::ptrdiff_t>(body.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t p = 0; p < n; ++p) {
      Vec<Dim> X;
      for (int a = 0; a < Dim; ++a) X[a] = body.initial_x[a][body.id[p]];
      const Vec<Dim> force = body_force<Dim>(one.mms, X, step.t);
      for (int a = 0; a < Dim; ++a) body.v[a][p] += step.dt * force[a];
    }
  }
}

#define GEODROP_INSTANTIATE(D)                                     \
  template std::vector<DrivenBody> driven_bodies<D>(const Scene&); \
  template void apply_body_force<D>(const std::vector<DrivenBody>&, State<D>&, const StepContext&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
