// The parts of cells beside a sharp interface that share one pressure and one volume rate.
#pragma once

#include <geodrop/grid/grid.hpp>

#include <algorithm>

namespace geodrop {

/// f(first, last) for the parts that share one pressure; they stand together in Grid::part_cells.
template <class Parts, class F>
void for_each_group(Parts& parts, F&& f) {
  auto first = std::find_if(parts.begin(), parts.end(), [](const auto& part) { return part.host >= 0; });
  while (first != parts.end()) {
    const auto last = std::find_if(first, parts.end(), [&](const auto& p) { return p.host != first->host; });
    f(first, last);
    first = last;
  }
}

/// Sum of a field of the grid over the cells of a group.
double sum_of_group(const Array<double>& of_cells, auto first, auto last) {
  double sum = 0;
  for (auto part = first; part != last; ++part) sum += of_cells[part->flat];
  return sum;
}

}  // namespace geodrop
