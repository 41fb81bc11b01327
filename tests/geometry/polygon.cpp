// Areas and winding numbers of closed lines of nodes.
#include "geometry/polygon.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace geodrop;

TEST_CASE("A polygon runs round the points inside once, in its own sense, and round those outside not at all") {
  Array<double> x{0, 2, 2, 0}, y{0, 0, 1, 1};
  CHECK(signed_area(x, y) == 2);
  CHECK(winding_number(x, y, {1, 0.5}) == 1);
  for (const Vec<2>& outside : {Vec<2>(-1, 0.5), Vec<2>(3, 0.5), Vec<2>(1, -1), Vec<2>(1, 2), Vec<2>(-1, 1)})
    CHECK(winding_number(x, y, outside) == 0);
  std::reverse(x.begin(), x.end());
  std::reverse(y.begin(), y.end());
  CHECK(signed_area(x, y) == -2);
  CHECK(winding_number(x, y, {1, 0.5}) == -1);
}

TEST_CASE("Where a polygon overlaps itself it runs round twice") {
  // A ring that is not closed: its ends overlap at 0 < x < 1, below.
  const Array<double> x{0, 3, 3, -2, -2, 1, 1, -1, -1, 2, 2, 0}, y{-2, -2, 2, 2, -3, -3, -1, -1, 1, 1, -1, -1};
  CHECK(winding_number(x, y, {0.5, -1.5}) == 2);
  CHECK(winding_number(x, y, {2.5, 0}) == 1);
  CHECK(winding_number(x, y, {-1.5, 0}) == 1);
  CHECK(winding_number(x, y, {0.5, 0}) == 0);  // in the hole
}
