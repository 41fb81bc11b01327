#include "asked_scene.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/reader/scene_reader.hpp>

#include <iostream>

#include "doubts/doubtful_units.hpp"
#include "reader/read_despite_mistakes.hpp"

namespace geodrop {

std::vector<std::string> doubts_beside_mistakes(const std::string& file, const std::vector<std::string>& overrides) {
  try {
    return doubtful_units(read_despite_mistakes(file, overrides));
  } catch (const SceneError&) {
    return {};
  }
}

Scene asked_scene(const std::string& file, const std::vector<std::string>& overrides) {
  try {
    return read_scene(file, overrides);
  } catch (const SceneError&) {
    for (const std::string& doubt : doubts_beside_mistakes(file, overrides)) std::cerr << "warning: " << doubt << '\n';
    throw;
  }
}

}  // namespace geodrop
