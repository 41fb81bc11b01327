// Edit distances counted by hand.
#include "base/nearest_name.hpp"

#include <doctest/doctest.h>

using namespace geodrop;

TEST_CASE("one edit each: insert, delete, replace, swap; case does not count") {
  CHECK(edit_distance("spacing", "spacing") == 0);
  CHECK(edit_distance("spacng", "spacing") == 1);
  CHECK(edit_distance("spaccing", "spacing") == 1);
  CHECK(edit_distance("spaxing", "spacing") == 1);
  CHECK(edit_distance("spacnig", "spacing") == 1);
  CHECK(edit_distance("Spacing", "spacing") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("the nearest name is the first of the nearest") {
  CHECK(nearest_name("watr", {"sand", "water", "waters"}) == "water");
  CHECK(nearest_name("x", {"a", "b"}).empty());  // not near
  CHECK(nearest_name("E", {"model", "density"}).empty());
  CHECK(nearest_name("rectangle", {"box", "ellipse", "polygon"}).empty());
  CHECK(nearest_name("rn", {"run", "check"}) == "run");
  CHECK(nearest_name("tset", {"run", "test"}) == "test");
  CHECK(nearest_name("friction_angle", {"density", "friction_angle_deg"}) == "friction_angle_deg");
  CHECK(nearest_name("body", {"bed", "water"}).empty());
  CHECK(nearest_name("x", {}).empty());
  CHECK(name_advice("x", {}, "bodies") == "nothing here: the scene has no bodies");
}

TEST_CASE("Names of a megabyte are compared by their beginning") {
  const std::string endless(1'000'000, 'x');
  CHECK(nearest_name(endless, {std::string(1'000'000, 'y'), "xxx"}).empty());
  CHECK(nearest_name(endless, {std::string(900'000, 'x')}) == std::string(900'000, 'x'));
}
