// `geodrop snapshot` and `geodrop animate`: pictures of frames, without a display.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "report/snapshot_picture.hpp"

namespace geodrop {

struct SnapshotArguments {
  std::string directory;
  double time = -1;  ///< < 0: the last frame
  PictureOptions picture;
  std::vector<double> window, range, tensions, cut;
  std::string output;
};

void add_snapshot_options(CLI::App& command, SnapshotArguments& arguments);
void add_animate_options(CLI::App& command, SnapshotArguments& arguments);

/// Return the exit code.
int run_snapshot(const SnapshotArguments& arguments);
int run_animate(const SnapshotArguments& arguments);

}  // namespace geodrop
