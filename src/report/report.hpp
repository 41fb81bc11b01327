// The report of a run: one page that can be handed in, with all its pictures inside.
#pragma once

#include <filesystem>
#include <string>

#include "calculators/tension_safety.hpp"

namespace geodrop {

struct ReportOptions {
  std::filesystem::path directory;  ///< of a run
  std::filesystem::path output;     ///< HTML
  TensionStrength factors{};        ///< of the design check; the strength is the scene's
};

/// Question, key figures, expectations, design check, histories, pictures at key instants, input, balances, timing,
/// warnings. Throws SceneError if the directory is no run's.
void write_report(const ReportOptions& options);

/// Prints a page to a PDF by the first program that is installed of Chromium and WeasyPrint; throws RunError that names
/// them if there is none.
void print_pdf(const std::filesystem::path& html, const std::filesystem::path& pdf);

}  // namespace geodrop
