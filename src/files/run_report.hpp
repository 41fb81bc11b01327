// What a run says of itself at its start and its end.
#pragma once

#include <geodrop/files/output.hpp>

#include <optional>
#include <string>
#include <vector>

namespace geodrop {

/// Digits of times in messages.
constexpr int time_digits = 6;

/// Program, machine, threads, scene.
std::string describe_run(const Scene& scene, const RunOptions& options);

std::string facts_text(const std::vector<Fact>& facts);

/// What stands before the command that goes on from the checkpoint of this time; empty if none does.
std::string how_to_go_on(RunStatus status, std::optional<double> checkpoint);

}  // namespace geodrop
