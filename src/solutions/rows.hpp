// The row of the step that drives bodies along manufactured solutions.
#pragma once

#include <geodrop/grid/row.hpp>

namespace geodrop {

template <int Dim>
Row<Dim> body_force_row(const Scene& scene);

}  // namespace geodrop
