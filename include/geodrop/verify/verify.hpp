// Verification: scenes that know a reference, run at several resolutions, beside it.
#pragma once

#include <filesystem>
#include <geodrop/scene/scene.hpp>
#include <string>
#include <vector>

namespace geodrop {

struct VerifyOptions {
  std::filesystem::path directory;            ///< results go here, each run into one of its own below
  int threads = 1;                            ///< also those of OpenMP
  VerifyMode mode = VerifyMode::quick;        ///< quick or full
  std::string only;                           ///< part of a case's name; empty: all
  std::vector<std::filesystem::path> scenes;  ///< empty: all of the source tree's cases that have a [[verify]]
  std::filesystem::path page;  ///< its generated part is written anew, rows.md and pictures go beside it; empty: none
};

/// Runs the cases, prints a row for each measure, writes verification.csv, verification_runs.csv, verification.md and
/// pictures of error against work. Returns the exit code: 0 all met, within a quick target or known to be missed and
/// within their guard, 1 a target, a guard or a control missed, 2 no case.
int run_verify(const VerifyOptions& options);

}  // namespace geodrop
