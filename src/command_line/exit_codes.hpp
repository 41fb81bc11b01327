// Exit codes of commands beside those of runs (geodrop/files/output.hpp).
#pragma once

namespace geodrop {

constexpr int exit_usage = 2;
constexpr int exit_internal = 70;

}  // namespace geodrop
