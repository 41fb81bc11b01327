#include "rows.hpp"

#include "body_force.hpp"

namespace geodrop {

template <int Dim>
Row<Dim> body_force_row(const Scene& scene) {
  const std::vector<DrivenBody> driven = driven_bodies<Dim>(scene);
  return {"body_force", Data::time | Data::initial_position | Data::position | Data::mass,
          Data::nodal_sums | Data::nodal_force, !driven.empty(),
          each_field<Dim>([driven](const State<Dim>& s, Grid<Dim>& g, const StepContext& step) {
            body_force_to_grid(driven, s, g, step);
          })};
}

template Row<2> body_force_row<2>(const Scene&);
template Row<3> body_force_row<3>(const Scene&);

}  // namespace geodrop
