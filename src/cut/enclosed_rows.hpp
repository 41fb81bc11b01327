// Rows of the step for a fluid that fills a closed membrane (PressureSupport::enclosed), in the plane.
#pragma once

#include <geodrop/grid/row.hpp>

namespace geodrop {

Row<2> enclosed_cells_row(const Scene& scene);
Row<2> enclosed_force_row(const Scene& scene);
Row<2> enclosed_load_row(const Scene& scene);
Row<2> enclosed_rate_row(const Scene& scene);

}  // namespace geodrop
