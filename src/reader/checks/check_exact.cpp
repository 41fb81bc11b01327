// Checks of exact solutions: the body exists and is of the right material, and who starts or is measured by a solution
// has one.
#include "check_scene.hpp"

#include <numbers>
#include <set>

#include "measure/probes/probes.hpp"

namespace geodrop {
namespace {

bool is_driven(const ExactSpec& exact) {
  return std::holds_alternative<AxisAlignedMmsSpec>(exact.solution) ||
         std::holds_alternative<GeneralizedVortexSpec>(exact.solution);
}

bool is_water(const ExactSpec& exact) {
  return std::holds_alternative<TaylorGreenSpec>(exact.solution) ||
         std::holds_alternative<OscillatingDropSpec>(exact.solution) ||
         std::holds_alternative<LambDipoleSpec>(exact.solution);
}

/// What a solution is of, in the scene's words.
const char* models_of(const ExactSpec& exact) {
  if (is_driven(exact)) return "neo_hookean";
  if (is_water(exact)) return "newtonian";
  return std::holds_alternative<BarFirstModeSpec>(exact.solution) ? "linear_elastic" : "linear_elastic or neo_hookean";
}

bool fits(const ExactSpec& exact, const MaterialSpec& material) {
  const bool rubber = std::holds_alternative<NeoHookeanSpec>(material.model);
  const bool elastic = std::holds_alternative<LinearElasticSpec>(material.model);
  if (is_driven(exact)) return rubber;
  if (std::holds_alternative<BarFirstModeSpec>(exact.solution)) return elastic;
  if (std::holds_alternative<UniformMotionSpec>(exact.solution)) return elastic || rubber;
  return std::holds_alternative<NewtonianSpec>(material.model);
}

void check_solution(const Scene& scene, const ExactSpec& exact, const std::string& key, Report& report) {
  if (!check_reference(key + ".body", exact.body, names_of(scene.bodies), "bodies", report)) return;
  const MaterialSpec* material = find_material(scene, find_body(scene, exact.body)->material);
  if (material && report.healthy("materials." + material->name) && report.healthy(key + ".type") &&
      !fits(exact, *material))
    report.add(key + ".body", '"' + exact.body + "\", a body of \"" + material->name + '"',
               "a body whose material is " + std::string(models_of(exact)));
  const auto* mms = std::get_if<AxisAlignedMmsSpec>(&exact.solution);
  if (mms && report.healthy(key + ".amplitude") && report.healthy(key + ".length") &&
      2 * std::numbers::pi * mms->amplitude >= mms->length)
    report.add(key + ".amplitude", to_text(mms->amplitude),
               "less than length / (2 pi) = " + to_text(mms->length / (2 * std::numbers::pi)) +
                   " [m], so that nothing turns inside out");
  if (std::holds_alternative<OscillatingDropSpec>(exact.solution) && scene.dimension != 2)
    report.add(key + ".type", "\"oscillating_drop\" in space", "with dimension = 2");
  if (std::holds_alternative<LambDipoleSpec>(exact.solution) && scene.dimension != 2)
    report.add(key + ".type", "\"lamb_dipole\" in space", "with dimension = 2");
  const auto* vortex = std::get_if<GeneralizedVortexSpec>(&exact.solution);
  if (vortex && report.healthy(key + ".radius") && report.healthy(key + ".half_width") &&
      vortex->half_width >= vortex->radius)
    report.add(key + ".half_width", to_text(vortex->half_width),
               "less than radius = " + to_text(vortex->radius) + " [m]");
}

void check_follower(const Scene& scene, const std::string& key, const std::string& body, Report& report) {
  if (!report.healthy(key) || !report.healthy("exact") || !find_body(scene, body) || find_exact(scene, body)) return;
  report.add(key, "\"exact\" for \"" + body + "\", which follows no exact solution",
             "a body that is named in [[exact]]");
}

/// A stretched body is a plain box: its lattice is filled unstrained, where other shapes have no place.
void check_stretched(const Scene& scene, const ExactSpec& exact, const std::string& key, Report& report) {
  const BodySpec* body = find_body(scene, exact.body);
  if (!body || !std::holds_alternative<UniformMotionSpec>(exact.solution) || !report.healthy(key) ||
      !report.healthy("bodies." + body->name))
    return;
  if (!std::holds_alternative<BoxShape>(body->shape) || !body->minus.empty())
    report.add(key + ".body", '"' + exact.body + "\", which is no plain box",
               "a body whose shape is a box and that has no minus");
}

}  // namespace

void check_exact(const Scene& scene, Report& report) {
  std::set<std::string> bodies;
  for (std::size_t i = 0; i < scene.exact.size(); ++i) {
    const std::string& key = report.element("exact", i);
    check_solution(scene, scene.exact[i], key, report);
    check_stretched(scene, scene.exact[i], key, report);
    if (!scene.exact[i].body.empty() && !bodies.insert(scene.exact[i].body).second)
      report.add(key + ".body", '"' + scene.exact[i].body + "\", which follows a solution already",
                 "one solution for each body");
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::string& key = report.element("bodies", i);
    const BodySpec& body = scene.bodies[i];
    if (std::holds_alternative<FromExactSpec>(body.initial_velocity))
      check_follower(scene, key + ".initial_velocity.type", body.name, report);
    if (std::holds_alternative<FromExactSpec>(body.initial_stress))
      check_follower(scene, key + ".initial_stress.type", body.name, report);
  }
  for (std::size_t i = 0; i < scene.probes.size(); ++i)
    if (const auto* probe = std::get_if<ExactProbeSpec>(&scene.probes[i].probe))
      check_follower(scene, report.element("probes", i) + ".type", probe->body, report);
}

}  // namespace geodrop
