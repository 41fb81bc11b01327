// `geodrop new`: a scene to begin with.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace geodrop {

struct NewSceneArguments {
  std::string name, from;
  bool list = false;
};

void add_new_scene_options(CLI::App& command, NewSceneArguments& arguments);

/// Writes NAME.toml: a bag of sand that is dropped in water, or a copy of a case; or prints the cases. Returns the exit
/// code. Throws SceneError if the file is there already, or there is no such case; CLI::RequiredError without a name.
int run_new_scene(const NewSceneArguments& arguments);

}  // namespace geodrop
