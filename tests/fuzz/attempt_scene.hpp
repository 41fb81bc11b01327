// What a scene has to stand: to be read or refused with a place, and three steps with a row of output if it is small.
#pragma once

#include "fuzz/fuzz.hpp"
#include "setup/memory_estimate.hpp"

#include <geodrop/measure/history.hpp>
#include <geodrop/reader/scene_reader.hpp>
#include <geodrop/step/pipeline.hpp>
#include <geodrop/step/run.hpp>

#include <sstream>

namespace geodrop::fuzz {

/// Each line of the message begins with the file and goes on with a line and column, or with --set.
inline bool names_places(const std::string& message, const std::string& file) {
  std::istringstream lines(message);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(file + ":")) return false;
    const std::string rest = line.substr(file.size() + 1);
    if (!rest.starts_with(" --set") && rest.find_first_of("0123456789") != 0) return false;
  }
  return !message.empty();
}

template <int Dim>
void make_steps(const Scene& scene) {
  State<Dim> state = build_state<Dim>(scene);
  Grids<Dim> grids = make_grids<Dim>(scene);
  Pipeline<Dim> pipeline = build_pipeline<Dim>(scene);
  HistoryTable history{history_columns(scene), {}};
  constexpr int steps = 3;
  for (int i = 0; i < steps && !is_over(scene, state); ++i) {
    advance(pipeline, state, grids);
    history.rows.push_back(history_row(scene, state, history));
  }
  for (const Result& result : reduce_all(scene, history)) (void)result;
}

inline bool is_small(const Scene& scene) {
  const MemoryEstimate estimate = estimate_memory(scene);
  return estimate.particles < 2e4 && estimate.cells < 2e5;
}

inline std::string attempt_scene(const std::string& path, const std::vector<std::string>& overrides) {
  bool read = false;
  try {
    const Scene scene = read_scene(path, overrides);
    read = true;
    if (!is_small(scene)) return "accepted, too large to run";
    check_results(scene);
    check_first_step(scene);
    scene.dimension == 2 ? make_steps<2>(scene) : make_steps<3>(scene);
    return "ran";
  } catch (const SceneError& error) {
    const std::string said = error.what();
    // What only building finds may have no line of its own.
    if (!read && !names_places(said, path)) return "failed: a message without a place: " + said.substr(0, 300);
    if (said.empty()) return "failed: an empty message";
    return read ? "refused when built" : "refused";
  } catch (const RunError& error) {
    return std::string(error.what()).empty() ? "failed: an empty message" : "broke in a step";
  }
}

}  // namespace geodrop::fuzz
