#include "report.hpp"

#include "output/text.hpp"

#include <geodrop/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace geodrop {
namespace {

constexpr int error_digits = 3;

std::string short_number(double value) { return std::isnan(value) ? "-" : format_number(value, error_digits); }

std::string joined(const std::vector<double>& values, const std::string& broken) {
  std::string text;
  for (const double value : values)
    text += (text.empty() ? "" : " ") + (std::isnan(value) ? broken : format_number(value, error_digits));
  return text;
}

std::string joined_spacings(const VerifyRow& row) {
  std::vector<double> spacings;
  for (const VariantRun* run : row.runs) spacings.push_back(run->spacing);
  return joined(spacings, "-");
}

/// Of the run that is judged.
const VariantRun& judged(const VerifyRow& row) { return *row.runs.back(); }

double wall_of(const VerifyRow& row) {
  double seconds = 0;
  for (const VariantRun* run : row.runs) seconds += run->wall_seconds;
  return seconds;
}

std::string target_text(const VerifyRow& row) {
  if (row.control) return "> " + format_number(row.target, error_digits);
  const std::string order = row.least_order > 0 ? ", order " + format_number(row.least_order, 2) : "";
  return "<= " + format_number(row.target, error_digits) + order;
}

std::string quoted(const std::string& text) {
  std::string word = "\"";
  for (const char letter : text) word += letter == '"' ? "'" : std::string(1, letter);
  return word + "\"";
}

std::string order_text(double order) {
  char text[16];
  std::snprintf(text, sizeof text, "%.1f", order);
  return std::isnan(order) ? "-" : text;
}

/// Bars part the cells of a table.
std::string cell(std::string text) {
  std::replace(text.begin(), text.end(), '|', '/');
  return " " + text + " |";
}

std::string reference_text(const VerifyRow& row) {
  const std::string unit = row.unit.empty() || row.unit == "1" ? "" : " " + row.unit;
  return format_number(row.expected, 6) + unit + ": " + row.source;
}

}  // namespace

std::string console_head() {
  char text[200];
  std::snprintf(text, sizeof text, "%-26s %-40s %-34s %5s %-18s %7s %6s  %s", "case", "error of", "errors", "order",
                "target", "wall s", "Mps/s", "met");
  return text;
}

std::string console_line(const VerifyRow& row) {
  char text[600];
  std::snprintf(text, sizeof text, "%-26s %-40s %-34s %5s %-18s %7.1f %6.2f  %s", row.scene.c_str(), row.what.c_str(),
                joined(row.errors, "breaks").c_str(), order_text(row.order).c_str(), target_text(row).c_str(),
                wall_of(row), judged(row).mpps(), word_of(row.verdict).c_str());
  return text;
}

std::string verify_totals(const std::vector<VerifyRow>& rows) {
  const auto count = [&](bool control, Verdict verdict) {
    return std::count_if(rows.begin(), rows.end(),
                         [&](const VerifyRow& row) { return row.control == control && row.verdict == verdict; });
  };
  const auto met = count(false, Verdict::met), known = count(false, Verdict::known),
             missed = count(false, Verdict::missed);
  const auto failing = count(true, Verdict::met), passing = count(true, Verdict::missed);
  return std::to_string(met) + " of " + std::to_string(met + known + missed) + " targets met, " +
         std::to_string(known) + " known to be missed, " + std::to_string(missed) + " missed; " +
         std::to_string(failing) + " of " + std::to_string(failing + passing) +
         " controls miss their target as they must";
}

std::string rows_csv(const std::vector<VerifyRow>& rows) {
  std::string text =
      "case,what,result,unit,expected,value,error,target,order,least_order,spacings_m,errors,wall_s,mpps,particles,"
      "steps,control,met,source,shortfall\n";
  for (const VerifyRow& row : rows) {
    const VariantRun& run = judged(row);
    text += quoted(row.scene) + "," + quoted(row.what) + "," + quoted(row.result) + "," + quoted(row.unit) + "," +
            format_number(row.expected) + "," + format_number(row.values.back()) + "," +
            format_number(row.errors.back()) + "," + format_number(row.target) + "," + format_number(row.order) + "," +
            format_number(row.least_order) + "," + quoted(joined_spacings(row)) + "," +
            quoted(joined(row.errors, "nan")) + "," + format_number(wall_of(row)) + "," + format_number(run.mpps()) +
            "," + format_number(run.particles) + "," + format_number(run.steps) + "," + (row.control ? "1" : "0") +
            "," + quoted(word_of(row.verdict)) + "," + quoted(row.source) + "," + quoted(row.shortfall) + "\n";
  }
  return text;
}

std::string runs_csv(const std::vector<VerifyRow>& rows) {
  std::string text =
      "case,result,variant,control,spacing_m,particles,steps,particle_steps,particle_bytes,wall_s,mpps,value,error,"
      "state_hash\n";
  for (const VerifyRow& row : rows)
    for (std::size_t i = 0; i < row.runs.size(); ++i) {
      const VariantRun& run = *row.runs[i];
      text += quoted(row.scene) + "," + quoted(row.result) + "," + quoted(run.name) + "," + (run.control ? "1" : "0") +
              "," + format_number(run.spacing) + "," + format_number(run.particles) + "," + format_number(run.steps) +
              "," + format_number(run.particle_steps()) + "," + format_number(run.bytes) + "," +
              format_number(run.wall_seconds) + "," + format_number(run.mpps()) + "," + format_number(row.values[i]) +
              "," + format_number(row.errors[i]) + "," + quoted(run.state_hash) + "\n";
    }
  return text;
}

std::string rows_markdown(const std::vector<VerifyRow>& rows) {
  std::string table =
                  "| case | error of | reference | spacing [m] | errors | order | target | wall [s] | million "
                  "particle-steps/s | "
                  "met |\n|---|---|---|---|---|---|---|---|---|---|\n",
              shortfalls;
  for (const VerifyRow& row : rows) {
    table += "|" + cell(row.scene) + cell(row.what) + cell(row.control ? "" : reference_text(row)) +
             cell(joined_spacings(row)) + cell(joined(row.errors, "breaks")) + cell(order_text(row.order)) +
             cell(target_text(row)) + cell(format_number(wall_of(row), 2)) + cell(short_number(judged(row).mpps())) +
             cell(row.verdict == Verdict::met ? "yes" : "**no**") + "\n";
    if (row.verdict == Verdict::known)
      shortfalls += "- **" + row.scene + "**, " + row.what + ": " + row.shortfall + "\n";
  }
  const std::string known = shortfalls.empty() ? "" : "\nKnown to be missed:\n" + shortfalls;
  return verify_totals(rows) + ".\n\n" + table + known;
}

std::string with_generated_part(const std::string& page, const std::string& generated) {
  const std::string first = "<!-- geodrop verify -->\n", last = "<!-- end of geodrop verify -->";
  const std::size_t begin = page.find(first), end = page.find(last);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw RunError("the page has no lines \"<!-- geodrop verify -->\" and \"" + last + "\"");
  return page.substr(0, begin + first.size()) + generated + page.substr(end);
}

}  // namespace geodrop
