#include "check.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/measure/results.hpp>
#include <geodrop/reader/scene_reader.hpp>
#include <geodrop/step/run.hpp>

#include <omp.h>

#include <cmath>
#include <cstdio>
#include <iostream>

#include "asked_scene.hpp"
#include "base/json.hpp"
#include "base/levels.hpp"
#include "doubts/doubts.hpp"
#include "exit_codes.hpp"
#include "files/build_identity.hpp"
#include "run.hpp"
#include "scene_file.hpp"
#include "step/effort.hpp"
#include "threads.hpp"

namespace geodrop {
namespace {

std::string counted(std::size_t count, const char* one, const char* several) {
  return std::to_string(count) + ' ' + (count == 1 ? one : several);
}

void print_notes(const Scene& scene) {
  for (const std::string& doubt : doubts(scene)) std::cout << "warning: " << doubt << '\n';
  for (const std::string& note : scene_notes(scene)) std::cout << "note: " << note << '\n';
}

Json json_of(const std::vector<SceneProblem>& problems) {
  Json items = Json::array();
  for (const SceneProblem& problem : problems)
    items.push_back({{"line", problem.at.line},
                     {"column", problem.at.column},
                     {"key", problem.key},
                     {"found", problem.found},
                     {"allowed", problem.allowed}});
  return items;
}

/// A number of things, rounded.
Json whole(double count) { return std::isfinite(count) ? Json(std::llround(count)) : Json(); }

Json json_of(const Effort& effort) {
  return {{"particles", whole(effort.particles)},
          {"steps", whole(effort.steps)},
          {"wall_s", effort.seconds},
          {"memory_bytes", whole(effort.memory_bytes)},
          {"output_bytes", whole(effort.output_bytes)},
          {"failure", effort.failure.empty() ? Json() : Json(effort.failure)}};
}

Json json_of(const Fact& fact) {
  const bool counts = fact.name.ends_with("_count") || fact.name.ends_with("_bytes");
  return counts ? whole(fact.value) : Json(fact.value);
}

/// Mistakes, warnings, notes and the effort of a run for other programs; the same exit codes.
int check_for_programs(const CheckArguments& arguments) {
  Json problems = Json::array(), warnings = Json::array(), notes = Json::array(), effort;
  int code = 0;
  try {
    const Scene scene = read_scene(arguments.scene, arguments.overrides);
    check_results(scene);
    check_first_step(scene);
    warnings = doubts(scene);
    notes = scene_notes(scene);
    effort = json_of(estimate_effort(scene, 1));
  } catch (const SceneError& error) {
    problems = json_of(error.problems());
    warnings = doubts_beside_mistakes(arguments.scene, arguments.overrides);
    code = exit_usage;
  }
  std::cout << json_text({{"file", arguments.scene},
                          {"problems", problems},
                          {"warnings", warnings},
                          {"notes", notes},
                          {"effort", effort}});
  return code;
}

/// Version and, of a scene, its facts and effort.
int info_for_programs(const CheckArguments& arguments, const BuildIdentity& build) {
  Json members = {{"version", build.version},
                  {"compiler", build.compiler},
                  {"cores", omp_get_num_procs()},
                  {"kernels", kernel_level_name()}};
  if (!arguments.scene.empty()) {
    const Scene scene = read_scene(arguments.scene, arguments.overrides);
    for (const Fact& fact : scene_facts(scene)) members[fact.name] = json_of(fact);
    const Effort effort = estimate_effort(scene, choose_threads(0));
    members["wall_s"] = effort.seconds;
    members["output_bytes"] = whole(effort.output_bytes);
  }
  std::cout << json_text(members);
  return 0;
}

void add_json(CLI::App& command, CheckArguments& arguments) {
  command.add_flag("--json", arguments.json, "print JSON, for other programs");
}

}  // namespace

void add_check_options(CLI::App& command, CheckArguments& arguments) {
  add_scene(command, arguments.scene, arguments.overrides);
  add_json(command, arguments);
}

void add_info_options(CLI::App& command, CheckArguments& arguments) {
  add_json(command, arguments);
  add_scene_argument(command, arguments.scene);
  command.add_option("--set", arguments.overrides, "override a key of the scene")->take_all()->expected(1);
}

int run_check(const CheckArguments& arguments) {
  if (arguments.json) return check_for_programs(arguments);
  const Scene scene = asked_scene(arguments.scene, arguments.overrides);
  check_results(scene);
  check_first_step(scene);
  std::cout << arguments.scene << ": no mistakes found; " << counted(scene.bodies.size(), "body", "bodies") << ", "
            << counted(scene.membranes.size(), "membrane", "membranes") << '\n';
  print_notes(scene);
  std::cout << "a run: " << effort_in_words(estimate_effort(scene, 1)) << '\n';
  return 0;
}

int run_stages(const CheckArguments& arguments) {
  std::cout << stages_text(read_scene(arguments.scene, arguments.overrides));
  return 0;
}

int run_info(const CheckArguments& arguments) {
  const BuildIdentity build = this_build();
  if (arguments.json) return info_for_programs(arguments, build);
  std::cout << "geodrop " << build.version << ", " << build.compiler << ", " << omp_get_num_procs()
            << " cores, kernels for " << kernel_level_name() << ", sums " << build.sums << '\n';
  if (arguments.scene.empty()) return 0;
  const Scene scene = read_scene(arguments.scene, arguments.overrides);
  for (const Fact& fact : scene_facts(scene)) std::printf("%-36s %.6g\n", fact.name.c_str(), fact.value);
  std::fflush(stdout);
  std::cout << "a run: " << effort_in_words(estimate_effort(scene, choose_threads(0))) << '\n';
  print_notes(scene);
  return 0;
}

}  // namespace geodrop
