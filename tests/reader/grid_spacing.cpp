// What the reader advises in place of a spacing that does not divide the domain is accepted when it is followed.
#include "support/near.hpp"
#include "support/scene_files.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace geodrop;

namespace {

std::string block_in(const std::string& domain, const std::string& walls) {
  return "title = \"A block\"\ngravity = [0.0, 0.0]\n"
         "[grid]\nlower = [0.0, 0.0]\n" +
         domain + "\n[walls]\n" + walls +
         "\n[solver]\ntransfer = \"tpic\"\n[time]\nend = 1.0\n[output]\nframe_interval = 1.0\nhistory_interval = 1.0\n"
         "[materials.rubber]\nmodel = \"linear_elastic\"\ndensity = 1000.0\nyoungs_modulus = 1e6\npoissons_ratio = "
         "0.3\n"
         "[[bodies]]\nname = \"block\"\nmaterial = \"rubber\"\ninitial_stress = { type = \"zero\" }\n"
         "shape = { type = \"box\", lower = [1.0, 1.0], upper = [9.0, 9.0] }\n";
}

const std::string slip = "left = \"slip\"\nright = \"slip\"\nbottom = \"slip\"\ntop = \"slip\"";

/// What stands between `before` and `after` in a message; empty if it does not.
std::string between(const std::string& message, const std::string& before, const std::string& after) {
  const std::size_t from = message.find(before);
  if (from == std::string::npos) return {};
  const std::size_t begin = from + before.size();
  return message.substr(begin, message.find(after, begin) - begin);
}

/// The spacing that the message about this scene advises, once it is seen to be accepted.
double accepted_advice(const std::string& text, const std::string& asked) {
  const std::string message = scene_error_of_text(text, {"grid.spacing=" + asked});
  INFO(message);
  const std::string advice = between(message, "the nearest is ", " [m]");
  REQUIRE_FALSE(advice.empty());
  CHECK(scene_error_of_text(text, {"grid.spacing=" + advice}) == "");
  return std::stod(advice);
}

}  // namespace

TEST_CASE("the spacing that is advised divides all axes") {
  const std::string text = block_in("upper = [32.0, 19.0]\nspacing = 1.0", slip);  // no more than 1 m divides both
  CHECK(accepted_advice(text, "0.3") == test::near(1.0 / 3, 1e-12));
  CHECK(accepted_advice(text, "0.29906542056074764") == test::near(1.0 / 3, 1e-12));
  CHECK(accepted_advice(text, "0.26") == test::near(0.25, 1e-12));
  CHECK(accepted_advice(text, "2.9") == test::near(1, 1e-12));
  CHECK(accepted_advice(text, "0.9") == test::near(1, 1e-12));
  CHECK(test::contains(scene_error_of_text(text, {"grid.spacing=0.3"}), "32 m along x and 19 m along y"));
}

TEST_CASE("a domain whose sides have no common measure near the spacing is to be changed") {
  const std::string text = block_in("upper = [11.37, 10.01]\nspacing = 0.25", slip);
  const std::string message = scene_error_of_text(text);
  INFO(message);
  const std::string upper = between(message, "none is near, but with grid.upper = ", " this one does");
  CHECK(upper == "[11.5, 10.25]");
  CHECK(scene_error_of_text(text, {"grid.upper=" + upper}) == "");
}

TEST_CASE("the spacing that is advised leaves periodic walls five cells apart") {
  const std::string periodic = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"slip\"\ntop = \"slip\"";
  const std::string domain = "upper = [10.0, 40.0]\nspacing = 1.0";
  CHECK(accepted_advice(block_in(domain, slip), "2.4") == test::near(2.5, 1e-12));
  CHECK(accepted_advice(block_in(domain, periodic), "2.4") == test::near(2, 1e-12));
}

TEST_CASE("the spacing that is advised is above that of a zone, whose axis it need not divide") {
  const std::string zone =
      "upper = [17.3, 12.0]\nspacing = 1.0\nrefine = [{ axis = \"x\", from = 4.0, to = 8.0, spacing = ";
  CHECK(accepted_advice(block_in(zone + "0.1 }]", slip), "0.7") == test::near(12.0 / 17, 1e-12));
  CHECK(accepted_advice(block_in(zone + "0.68 }]", slip), "0.67") == test::near(12.0 / 17, 1e-12));
}
