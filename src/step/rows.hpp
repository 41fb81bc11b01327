// Rows of the step that follow the run as a whole: its stages in time, its rest, its energies.
#pragma once

#include <geodrop/grid/row.hpp>

namespace geodrop {

template <int Dim>
Row<Dim> stable_dt_row(const Scene& scene);
template <int Dim>
Row<Dim> scene_stages_row(const Scene& scene);
template <int Dim>
Row<Dim> out_of_balance_row(const Scene& scene);
template <int Dim>
Row<Dim> pumps_row(const Scene& scene);
template <int Dim>
Row<Dim> kinetic_damping_row(const Scene& scene);
template <int Dim>
Row<Dim> energy_watch_row(const Scene& scene);

}  // namespace geodrop
