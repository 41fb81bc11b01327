// A field that is added to a list is sorted, saved, hashed, counted, fetched and shown, and nothing else has to know.
#include <geodrop/grid/grid.hpp>
#include <geodrop/state/fields.hpp>

#include <doctest/doctest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "grid/blocks.hpp"
#include "grid/sort_particles.hpp"
#include "measure/particle_columns.hpp"
#include "state/archive.hpp"
#include "support/random_particles.hpp"
#include "transfer/chunk_laws.hpp"

namespace geodrop {
namespace {

/// Particles with one field more than there are.
struct Damaged : Particles<2> {
  Array<double> damage;
};

constexpr auto longer_list = [] {
  using namespace particle_role;
  return std::tuple_cat(particle_fields<2>, std::tuple{field<per_particle | gathered | rate | shown_if_any>(
                                                "damage", "-", &Damaged::damage)});
}();
constexpr const auto& fields_of(const Damaged&) { return longer_list; }

/// The same for the grid.
struct MarkedGrid : GridFields {
  Array<int> mark;
};
constexpr auto longer_grid_list =
    std::tuple_cat(grid_fields, std::tuple{field<grid_role::zero_each_step>("mark", "-", &MarkedGrid::mark)});
constexpr const auto& fields_of(const MarkedGrid&) { return longer_grid_list; }

Damaged three_particles() {
  Damaged particles;
  for_each_array<particle_role::every_body>(particles, [](auto& values) { values.assign(3, 0.5); });
  particles.id = {0, 1, 2};
  particles.layer = {4, 5, 6};
  particles.damage = {10, 11, 12};
  return particles;
}

/// An archive that keeps what it is given as bytes, as checkpoint and hash do.
struct Bytes {
  std::string text;
  template <class T>
  void bytes(const T* first, std::size_t count) {
    text.append(reinterpret_cast<const char*>(first), count * sizeof(T));
  }
  std::size_t length(std::size_t present, std::size_t) {
    bytes(&present, 1);
    return present;
  }
};

std::string saved(const Damaged& particles) {
  Bytes out;
  walk(out, particles);
  return out.text;
}

/// An archive that reads what Bytes kept.
struct Reread {
  std::string text;
  std::size_t at = 0;
  template <class T>
  void bytes(T* first, std::size_t count) {
    text.copy(reinterpret_cast<char*>(first), count * sizeof(T), at);
    at += count * sizeof(T);
  }
  std::size_t length(std::size_t, std::size_t) {
    std::size_t count = 0;
    bytes(&count, 1);
    return count;
  }
};

/// A law of doubles, and three that are not.
struct Doubles {
  double a, b;
};
struct WithFlag {
  double a;
  bool b;
};
struct WithTwoNumbers {
  double a;
  float b, c;
};
struct WithPointer {
  double a;
  const double* b;
};

}  // namespace

TEST_CASE("A new field moves with its particle, one by id stays") {
  Damaged particles = three_particles();
  permute(particles, {2, 0, 1});
  CHECK(particles.damage == Array<double>{12, 10, 11});
  CHECK(particles.id == Array<std::uint32_t>{2, 0, 1});
  CHECK(particles.layer == Array<std::uint8_t>{4, 5, 6});
}

TEST_CASE("A new field is saved, read and hashed") {
  const Damaged particles = three_particles();
  Reread in{saved(particles)};
  Damaged back;
  walk(in, back);
  CHECK(in.at == in.text.size());
  CHECK(back.damage == particles.damage);
  CHECK(saved(back) == saved(particles));
  back.damage[1] = 11.5;
  CHECK(saved(back) != saved(particles));
}

TEST_CASE("A new field is counted, and stops") {
  Damaged particles = three_particles();
  // 2 x, 2 v, 4 of the affine rate, mass, J, 2 initial x, damage; id; layer
  CHECK(particle_bytes(particles) == 3 * (13 * 8 + 4 + 1));
  std::vector<const double*> rates;
  for_each_array<particle_role::rate>(particles, [&](const auto& values) { rates.push_back(values.data()); });
  CHECK(rates.size() == 7);
  CHECK(rates.back() == particles.damage.data());
  CHECK(count_arrays<particle_role::gathered>(longer_list) ==
        count_arrays<particle_role::gathered>(particle_fields<2>) + 1);
}

TEST_CASE("A new field is shown where there is one") {
  std::map<std::string, std::vector<float>> shown;
  const auto column = [&](const std::string& name, const std::vector<std::string>& components, auto write) {
    CHECK(components.empty());
    shown[name].resize(3);
    for (std::size_t p = 0; p < 3; ++p) write(p, &shown[name][p]);
  };
  Damaged particles = three_particles();
  for_each_shown_field(particles, column);
  CHECK(shown.at("damage") == std::vector<float>{10, 11, 12});
  CHECK(shown.at("pore_pressure") == std::vector<float>{0, 0, 0});
  CHECK(shown.count("gap") == 0);
  shown.clear();
  particles.damage.clear();
  for_each_shown_field(particles, column);
  CHECK(shown.count("damage") == 0);
}

TEST_CASE("A new field of the grid is zeroed, one of another role is not") {
  MarkedGrid grid;
  grid.mark = {1, 2, 3, 4};
  grid.velocity_change.assign(4, Vec4{1, 1, 1, 1});
  zero_row<grid_role::zero_each_step>(grid, 1, 2);
  CHECK(grid.mark == Array<int>{1, 0, 0, 4});
  CHECK(grid.velocity_change[1][0] == 1);
}

TEST_CASE("Every field stands in its list once, under a name of its own") {
  const auto check = [](auto owner) {
    std::set<std::string> names;
    std::set<const void*> places;
    std::size_t count = 0;
    for_each_field<any_role>(owner, [&](const auto& entry, const auto& values) {
      names.insert(entry.name);
      places.insert(&values);
      ++count;
      CHECK(std::string(entry.unit) != "");
    });
    CHECK(names.size() == count);
    CHECK(places.size() == count);
  };
  check(Particles<2>{});
  check(Particles<3>{});
  check(GridFields{});
}

TEST_CASE("What a law needs is allocated, and nothing else") {
  const auto needs = [](const auto& law) {
    const Particles<2> particles;
    std::set<const void*> wanted;
    law.state(particles, [&](const auto& field) { wanted.insert(&field); });
    std::string names;
    for_each_field<any_role>(particles, [&](const auto& entry, const auto& values) {
      if (wanted.count(&values)) names += std::string(names.empty() ? "" : " ") + entry.name;
    });
    return names;
  };
  CHECK(needs(Newtonian{1000, 2e9, 0}) == "");
  CHECK(needs(Newtonian{1000, 2e9, 1e-3}) == "stress");
  CHECK(needs(LinearElastic{}) == "stress");
  CHECK(needs(NeoHookean{}) == "stress deformation");
  MohrCoulombWithVoids soil{};
  CHECK(needs(static_cast<const MohrCoulomb&>(soil)) == "stress deviatoric_strain");
  soil.pore_stiffness = 1e8;
  CHECK(needs(soil) == "stress pore_pressure deviatoric_strain gap");
}

TEST_CASE("A law of anything but doubles is refused") {
  CHECK(only_doubles<Doubles>);
  CHECK(only_doubles<MohrCoulombWithVoids>);
  CHECK_FALSE(only_doubles<WithFlag>);
  CHECK_FALSE(only_doubles<WithTwoNumbers>);
  CHECK_FALSE(only_doubles<WithPointer>);
}

}  // namespace geodrop
