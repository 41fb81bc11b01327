#include "report.hpp"

#include <iostream>

#include "only_if.hpp"
#include "report/compare.hpp"
#include "unfinished_runs.hpp"

namespace geodrop {

namespace fs = std::filesystem;

void add_report_options(CLI::App& command, ReportArguments& arguments) {
  command.add_option("directory", arguments.directory, "run directory")->required();
  command.add_option("--output", arguments.output, "HTML (default: report.html in the directory)")
      ->check(only_if<std::string>([](const std::string& file) { return file.ends_with(".html"); }, "a file .html"));
  command.add_flag("--pdf", arguments.pdf, "print it to PDF, too, by chromium or weasyprint if one is installed");
  command
      .add_option("--seam-efficiency", arguments.factors.seam_efficiency,
                  "for the design check: strength of a seam over that of the geotextile")
      ->check(only_if<double>([](double share) { return share > 0 && share <= 1; }, "a share > 0, at most 1"));
  const auto add_factor = [&](const char* name, std::optional<double>& factor, const char* about) {
    command.add_option(name, factor, about)
        ->check(only_if<double>([](double value) { return value >= 1; }, "a reduction factor >= 1"));
  };
  add_factor("--reduction-installation", arguments.factors.installation, "reduction factor of damage at installation");
  add_factor("--reduction-creep", arguments.factors.creep, "reduction factor of creep");
  add_factor("--reduction-durability", arguments.factors.durability,
             "reduction factor of chemical and biological degradation");
}

void add_compare_options(CLI::App& command, CompareArguments& arguments) {
  command.add_option("directories", arguments.directories, "two or more run directories")->required()->expected(2, 20);
}

int run_report(const ReportArguments& arguments) {
  tell_unfinished_runs({arguments.directory});
  const fs::path directory = arguments.directory;
  const fs::path page = arguments.output.empty() ? directory / "report.html" : fs::path(arguments.output);
  write_report({directory, page, arguments.factors});
  std::cout << page.string() << '\n';
  if (!arguments.pdf) return 0;
  fs::path pdf = page;
  pdf.replace_extension(".pdf");
  print_pdf(page, pdf);
  std::cout << pdf.string() << '\n';
  return 0;
}

int run_compare(const CompareArguments& arguments) {
  tell_unfinished_runs(arguments.directories);
  std::cout << compare_runs({arguments.directories.begin(), arguments.directories.end()});
  return 0;
}

}  // namespace geodrop
