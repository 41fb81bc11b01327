// What a user should know of a scene before the first step.
#include <geodrop/base/error.hpp>
#include <geodrop/step/pipeline.hpp>
#include <geodrop/step/run.hpp>

#include "initial_state.hpp"
#include "pores/pore_soils.hpp"
#include "setup/memory_estimate.hpp"
#include "solutions/initial_stress.hpp"
#include "stable_dt.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace geodrop {
namespace {

/// Density at the lowest particle of a still fluid over its density at zero pressure, less one.
template <int Dim>
double density_rise(const Body<Dim>& body) {
  const auto lowest = std::min_element(body.J.begin(), body.J.end());
  return lowest == body.J.end() ? 0.0 : 1 / *lowest - 1;
}

template <int Dim>
std::string stages_in(const Scene& scene) {
  std::string text;
  for (const Row<Dim>& row : build_pipeline<Dim>(scene))
    text += fmt::format("{:19} {} -> {}\n", row.name, names_of(row.reads), names_of(row.writes));
  return text;
}

}  // namespace

template <int Dim>
std::vector<Fact> state_facts(const Scene& scene, const State<Dim>& state) {
  std::vector<Fact> facts;
  double memory = 0;
  for (const Body<Dim>& body : state.bodies) {
    memory += particle_bytes(body);
    facts.push_back({body.name + ".particles_count", static_cast<double>(body.size())});
    facts.push_back({body.name + ".wave_speed_m_s", wave_speed(body.material)});
    if (const auto* fluid = std::get_if<Newtonian>(&body.material)) {
      facts.push_back({body.name + ".density_rise_ratio", density_rise(body)});
      if (fluid->cavitates()) facts.push_back({body.name + ".suction_limit_Pa", fluid->tension_cutoff});
    }
    const MohrCoulomb* soil = soil_law(body.material);
    if (soil && soil->pore_stiffness > 0) facts.push_back({body.name + ".skempton_b_ratio", skempton_b(*soil)});
  }
  for (const PoreSoil& soil : pore_soils(scene)) {
    const Consolidation drains = consolidation(scene, soil);
    const std::string& name = scene.bodies[soil.body].name;
    facts.push_back({name + ".consolidation_coefficient_m2_s", drains.coefficient});
    facts.push_back({name + ".time_factor_ratio", drains.time_factor});
  }
  const GridLayout<Dim> layout(scene.grid, scene.walls);
  const double particles = static_cast<double>(state.particles()), dt = stable_dt(scene, state, layout);
  facts.push_back({"particles_count", particles});
  facts.push_back({"bytes_per_particle_count", memory / particles});
  facts.push_back({"grid_nodes_count", static_cast<double>(layout.nodes())});
  facts.push_back({"time_step_s", dt});
  facts.push_back({"steps_count", scene.time.end / dt});
  return facts;
}

template std::vector<Fact> state_facts<2>(const Scene&, const State<2>&);
template std::vector<Fact> state_facts<3>(const Scene&, const State<3>&);

std::vector<Fact> scene_facts(const Scene& scene) {
  require_memory(scene);
  std::vector<Fact> facts =
      scene.dimension == 2 ? state_facts(scene, initial_state<2>(scene)) : state_facts(scene, initial_state<3>(scene));
  facts.push_back({"memory_bytes", estimate_memory(scene).bytes});
  return facts;
}

void check_first_step(const Scene& scene) {
  try {
    scene_facts(scene);
  } catch (const RunError& error) {
    throw SceneError(scene.file, {{{1, 1}, "time", error.what(), "a scene whose first time step can be made"}});
  }
}

std::string stages_text(const Scene& scene) { return scene.dimension == 2 ? stages_in<2>(scene) : stages_in<3>(scene); }

}  // namespace geodrop
