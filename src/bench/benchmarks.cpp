#include "benchmarks.hpp"

#include "reader/key_table.hpp"
#include "solutions/initial_stress.hpp"

#include <algorithm>
#include <cmath>

namespace geodrop {
namespace {

// A new basis is one word here, and its costs in work_counts.cpp.
constexpr Basis shipped_bases[] = {Basis::bspline2, Basis::gimp, Basis::linear, Basis::tri3, Basis::tet4};

bool exists(Basis basis, int dimension) {
  return basis == Basis::tri3 ? dimension == 2 : basis == Basis::tet4 ? dimension == 3 : true;
}

/// The average that cures a basis of locking and noise.
PressureSupport average_of(Basis basis) { return is_simplex(basis) ? PressureSupport::nodal : PressureSupport::cell; }

struct ShippedMaterial {
  const char* short_name;  ///< heads the names of benchmarks
  const char* name;        ///< in tables
  decltype(MaterialSpec::model) model;
};
/// In the order of BenchMaterial.
const ShippedMaterial shipped_materials[] = {
    {"water", "newtonian", NewtonianSpec{1000, 3.6e6, 0}},
    {"viscous", "newtonian_viscous", NewtonianSpec{1000, 3.6e6, 8.9e-4}},
    {"elastic", "linear_elastic", LinearElasticSpec{2000, 10e6, 0.33}},
    {"rubber", "neo_hookean", NeoHookeanSpec{2000, 10e6, 0.33}},
    {"soil", "mohr_coulomb", MohrCoulombSpec{2000, 10e6, 0.33, 0, 30, 0, 0, {}}},
    {"undrained", "mohr_coulomb_undrained", MohrCoulombSpec{2000, 10e6, 0.33, 0, 30, 0, 0, UndrainedSpec{0.4, 80e6}}},
};
const ShippedMaterial& shipped(BenchMaterial material) { return shipped_materials[static_cast<std::size_t>(material)]; }

constexpr double confinement = 10e3;  // [Pa]; its release at free faces moves them by less than 1 % of the motion

/// Puts soil on its yield surface, sheared as far as the mean stress allows, in the sense of the motion.
template <int Dim>
void shear_stress(const MohrCoulomb& soil, double direction, Body<Dim>& body) {
  for (int c = 0; c < 3; ++c) std::fill(body.stress[c].begin(), body.stress[c].end(), -confinement);
  std::fill(body.stress[3].begin(), body.stress[3].end(), direction * confinement * soil.sin_phi);
}

/// K0 stress, by Jaky 1 - sin(phi).
template <int Dim>
void rest_stress(const MohrCoulomb& soil, Body<Dim>& body) {
  for (int c = 0; c < 3; ++c)
    std::fill(body.stress[c].begin(), body.stress[c].end(), -confinement * (c == 1 ? 1 : 1 - soil.sin_phi));
}

/// Takes all motion, strain and stress back.
template <int Dim>
void renew(Body<Dim>& body) {
  for (int a = 0; a < Dim; ++a)
    for (std::size_t p = 0; p < body.size(); ++p) body.x[a][p] = body.initial_x[a][body.id[p]];
  std::fill(body.J.begin(), body.J.end(), 1.0);
  set_unstrained(body);
}

}  // namespace

std::string name_of(Basis basis) { return word_of("grid", "basis", basis); }
std::string name_of(Transfer transfer) { return word_of("solver", "transfer", transfer); }
std::string name_of(PressureSupport pressure) { return word_of("bodies", "pressure", pressure); }
std::string name_of(BenchMaterial material) { return shipped(material).name; }

std::vector<Benchmark> all_benchmarks() {
  std::vector<Benchmark> all;
  for (const int dimension : {2, 3})
    for (const Basis basis : shipped_bases) {
      if (!exists(basis, dimension)) continue;
      const Transfer plain = is_simplex(basis) ? Transfer::musl : Transfer::tpic;
      const auto add = [&](BenchMaterial material, const std::string& suffix, Transfer transfer,
                           PressureSupport pressure) {
        const std::string name = std::string(shipped(material).short_name) + "_" + std::to_string(dimension) + "d_" +
                                 name_of(basis) + suffix;
        all.push_back({{dimension, basis, material, transfer, pressure}, name});
      };
      for (std::size_t m = 0; m < std::size(shipped_materials); ++m) {
        const auto material = static_cast<BenchMaterial>(m);
        // A free corner of rubber on hat functions tears itself apart within 40 steps unless MUSL holds it.
        const bool tears = basis == Basis::linear && material == BenchMaterial::rubber;
        add(material, "", tears ? Transfer::musl : plain, PressureSupport::particle);
      }
      add(BenchMaterial::soil, "_at_rest", plain, PressureSupport::particle);
      all.back().at_rest = true;
      const PressureSupport average = average_of(basis);
      for (const BenchMaterial material : {BenchMaterial::water, BenchMaterial::soil})
        add(material, "_" + name_of(average), plain, average);
      if (plain == Transfer::tpic) add(BenchMaterial::water, "_blend", Transfer::blend, PressureSupport::particle);
      if (basis != Basis::bspline2) continue;
      for (const PressureSupport pressure : {PressureSupport::particle, average}) {
        add(BenchMaterial::water, pressure == average ? "_graded_cell" : "_graded", plain, pressure);
        all.back().graded = true;
      }
    }
  return all;
}

std::vector<SceneBenchmark> scene_benchmarks() {
  const std::string main_case = "cases/dump_kekerdom.toml";
  return {{"main_case", main_case, {}},
          {"main_case_uniform", main_case, {"grid.spacing=0.25", "grid.refine=[]"}},
          {"main_case_coarse", main_case, {"grid.refine=[]"}},
          {"geotube", "cases/geotube_556.toml", {}},
          {"two_containers", "cases/two_containers.toml", {}},
          {"bed_3d", "cases/k0_bed_3d.toml", {}}};
}

Scene block_scene(const Benchmark& bench, const BlockSize& size) {
  constexpr int margin = 8;  // cells
  constexpr int per_cell_axis = 2;
  const int d = bench.dimension;
  const int cells = static_cast<int>(std::lround(std::pow(size.particles, 1.0 / d) / per_cell_axis));
  const int box = static_cast<int>(std::lround((cells + 2 * margin) * size.domain_factor));
  const int beside = (box - cells) / 2;  // whole: blocks of different boxes lie alike in their cells
  const double low = beside;
  Scene scene;
  scene.dimension = d;
  scene.grid = {Point(d, 0.0), Point(d, box), 1, bench.basis, {}};
  for (int a = 0; bench.graded && a < d; ++a) scene.grid.refine.push_back({a, low, low + cells, 1, 1.1, {}});
  scene.walls.lower.assign(d, WallKind::slip);
  scene.walls.upper = scene.walls.lower;
  scene.gravity.assign(d, 0.0);
  scene.solver.transfer = bench.transfer;
  scene.solver.blend_rate = bench.transfer == Transfer::tpic ? 0 : 10;
  scene.time.end = 1e3;
  const ShippedMaterial& material = shipped(bench.material);
  scene.materials.push_back({material.short_name, material.model, {}});
  if (auto* soil = std::get_if<MohrCoulombSpec>(&scene.materials[0].model); soil && bench.at_rest) {
    // Holds the free faces together, whose release of stress would yield half way into a small block.
    soil->cohesion = 20e3;
    soil->tension_cutoff = 20e3;
  }
  BodySpec body;
  body.name = "block";
  body.material = scene.materials[0].name;
  body.shape = BoxShape{Point(d, low), Point(d, low + cells)};
  body.particles_per_cell_axis = per_cell_axis;
  // A lattice that moves as a whole stays sorted, and sorting it would be free.
  body.jitter = 0.4;
  body.pressure = bench.pressure;
  body.initial_velocity = UniformVelocitySpec{Point(d, 0.0)};  // set_in_motion knows better
  scene.bodies.push_back(body);
  return scene;
}

template <int Dim>
void set_in_motion(const Benchmark& bench, const Scene& scene, double direction, State<Dim>& state) {
  constexpr double drift_share = 0.15;
  const double shear_share = bench.at_rest ? 0.003 : 0.03;
  Body<Dim>& body = state.bodies[0];
  renew(body);
  state.drift = -1;  // sort before the next step
  const double c = wave_speed(body.material);
  const double middle = 0.5 * (scene.grid.lower[1] + scene.grid.upper[1]);
  const auto& box = std::get<BoxShape>(scene.bodies[0].shape);
  const double rate = direction * 2 * shear_share * c / (box.upper[1] - box.lower[1]);
  for (auto& component : body.affine) std::fill(component.begin(), component.end(), 0.0);
  std::fill(body.affine[1].begin(), body.affine[1].end(), rate);
  for (int a = 0; a < Dim; ++a) std::fill(body.v[a].begin(), body.v[a].end(), direction * drift_share * c);
  for (std::size_t p = 0; p < body.size(); ++p) body.v[0][p] += rate * (body.x[1][p] - middle);
  state.v_max =
      c * std::sqrt((drift_share + shear_share) * (drift_share + shear_share) + (Dim - 1) * drift_share * drift_share);
  const auto* soil = std::get_if<MohrCoulomb>(&body.material);
  if (soil && bench.at_rest) rest_stress(*soil, body);
  if (soil && !bench.at_rest) shear_stress(*soil, direction, body);
}

template void set_in_motion<2>(const Benchmark&, const Scene&, double, State<2>&);
template void set_in_motion<3>(const Benchmark&, const Scene&, double, State<3>&);

}  // namespace geodrop
