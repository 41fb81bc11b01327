// `geodrop report` and `geodrop compare`.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "report/report.hpp"

namespace geodrop {

struct ReportArguments {
  std::string directory, output;
  bool pdf = false;
  TensionStrength factors{};
};

struct CompareArguments {
  std::vector<std::string> directories;
};

void add_report_options(CLI::App& command, ReportArguments& arguments);
void add_compare_options(CLI::App& command, CompareArguments& arguments);

/// Return the exit code.
int run_report(const ReportArguments& arguments);
int run_compare(const CompareArguments& arguments);

}  // namespace geodrop
