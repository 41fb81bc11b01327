#include "report.hpp"

#include "base/text.hpp"

#include <geodrop/base/error.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geodrop {
namespace {

constexpr int error_digits = 3;

std::string error_cell(double value) { return std::isnan(value) ? "-" : format_number(value, error_digits); }

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

/// Beside a quick target or a guard stands the target that it takes the place of.
std::string target_text(const VerifyRow& row) {
  if (row.control) return row.judged_by_break() ? "breaks" : "> " + format_number(row.bar, error_digits);
  std::string text = "<= " + format_number(row.bar, error_digits);
  if (row.bar != row.target) text += " (" + format_number(row.target, error_digits) + ")";
  if (row.least_order > 0)
    text += ", order " + format_number(row.least_order, 2) + (row.judges_order ? "" : " not judged");
  return text;
}

std::string slack_text(const VerifyRow& row) {
  const double factor = slack(row);
  if (std::isinf(factor)) return "exact";
  if (std::isnan(factor)) return "-";
  return factor < 99.5 ? fmt::format("{:.1f}", factor) : fmt::format("{:.0e}", factor);
}

std::string quoted(const std::string& text) {
  std::string word = "\"";
  for (const char letter : text) word += letter == '"' ? "'" : std::string(1, letter);
  return word + "\"";
}

std::string order_text(double order) { return std::isnan(order) ? "-" : fmt::format("{:.1f}", order); }

/// Bars part the cells of a table.
std::string cell(std::string text) {
  std::replace(text.begin(), text.end(), '|', '/');
  return " " + text + " |";
}

std::string reference_text(const VerifyRow& row) {
  const std::string unit = row.unit.empty() || row.unit == "1" ? "" : " " + row.unit;
  if (row.control) return (row.judged_by_break() ? "belongs to: " : "has to miss: ") + row.misses;
  const std::string kind = row.kind == ReferenceKind::regression ? "regression, " : "";
  return kind + format_number(row.expected, 6) + unit + ": " + row.source;
}

using Rows = std::vector<VerifyRow>;

template <class Holds>
std::string count_of(const Rows& rows, Holds holds) {
  return std::to_string(std::count_if(rows.begin(), rows.end(), holds));
}

/// Of the measures, controls left out.
std::string count_kind(const Rows& rows, ReferenceKind kind) {
  return count_of(rows, [&](const VerifyRow& row) { return !row.control && row.kind == kind; });
}

std::string count_references(const Rows& rows, Verdict verdict) {
  return count_of(rows, [&](const VerifyRow& row) {
    return !row.control && row.kind == ReferenceKind::reference && row.verdict == verdict;
  });
}

bool holds_as_regression(const VerifyRow& row) {
  return !row.control && row.kind == ReferenceKind::regression && row.verdict != Verdict::missed;
}

/// What a row adds to the row of its case: the worst verdict stands for the case, then the error nearest to its target.
bool is_harder(const VerifyRow& row, const VerifyRow& other) {
  const auto share = [](const VerifyRow& one) {
    const double part = one.errors.back() / one.target;
    return std::isnan(part) ? std::numeric_limits<double>::infinity() : part;
  };
  return row.verdict != other.verdict ? row.verdict > other.verdict : share(row) > share(other);
}

/// The rows of one case, which stand one after the other in the table.
struct CaseSummary {
  const VerifyRow* hardest = nullptr;  ///< of its measures
  int measures = 0, met = 0, controls = 0, controls_failing = 0;

  void add(const VerifyRow& row) {
    const bool is_met = row.verdict == Verdict::met;
    if (row.control) {
      ++controls;
      controls_failing += is_met;
      return;
    }
    ++measures;
    met += is_met;
    if (!hardest || is_harder(row, *hardest)) hardest = &row;
  }
};

std::vector<CaseSummary> by_case(const Rows& rows) {
  std::vector<CaseSummary> cases;
  const VerifyRow* last = nullptr;
  for (const VerifyRow& row : rows) {
    if (!last || row.scene != last->scene) cases.emplace_back();
    cases.back().add(row);
    last = &row;
  }
  std::erase_if(cases, [](const CaseSummary& one) { return !one.hardest; });
  return cases;
}

std::string verdict_cell(Verdict verdict) {
  return cell(verdict == Verdict::met ? "yes" : "**" + word_of(verdict) + "**");
}

std::string part_of(int part, int all) { return std::to_string(part) + " of " + std::to_string(all); }

std::string case_line(const CaseSummary& one) {
  const VerifyRow& row = *one.hardest;
  return "|" + cell(row.scene) + cell(row.what) + cell(joined({row.errors.back()}, "breaks")) +
         cell(order_text(row.order)) + cell(target_text(row)) + verdict_cell(row.verdict) +
         cell(part_of(one.met, one.measures)) + cell(part_of(one.controls_failing, one.controls)) + "\n";
}

/// "- **case**, measure: reason" of the measures that have something to tell.
template <class Reason>
std::string list_of(const Rows& rows, const std::string& heading, Reason reason) {
  std::string list;
  for (const VerifyRow& row : rows)
    if (const std::string text = row.control ? "" : reason(row); !text.empty())
      list += "- **" + row.scene + "**, " + row.what + ": " + text + "\n";
  return list.empty() ? "" : "\n" + heading + ":\n" + list;
}

}  // namespace

std::string console_head() {
  return fmt::format("{:26} {:40} {:34} {:>5} {:26} {:>6} {:>7} {:>6}  {}", "case", "error of", "errors", "order",
                     "target (of --full)", "factor", "wall s", "Mps/s", "met");
}

std::string console_line(const VerifyRow& row) {
  return fmt::format("{:26} {:40} {:34} {:>5} {:26} {:>6} {:7.1f} {:6.2f}  {}{}", row.scene, row.what,
                     joined(row.errors, "breaks"), order_text(row.order), target_text(row), slack_text(row),
                     wall_of(row), judged(row).mpps(), word_of(row.verdict),
                     row.control ? " (" + reference_text(row) + ")" : "");
}

std::string verify_totals(const Rows& rows) {
  const auto is_control = [](const VerifyRow& row) { return row.control; };
  const auto fails = [](const VerifyRow& row) { return row.control && row.verdict == Verdict::met; };
  return count_references(rows, Verdict::met) + " of " + count_kind(rows, ReferenceKind::reference) + " targets met, " +
         count_references(rows, Verdict::coarse) + " coarse: within their quick target, " +
         count_references(rows, Verdict::guarded) + " known to be missed, guarded, " +
         count_references(rows, Verdict::missed) + " missed; " + count_of(rows, holds_as_regression) + " of " +
         count_kind(rows, ReferenceKind::regression) + " regressions hold; " + count_of(rows, fails) + " of " +
         count_of(rows, is_control) + " controls miss the target of their row as they must";
}

std::string slack_totals(const Rows& rows) {
  const auto measure = [](const VerifyRow& row) { return !row.control; };
  const auto reasoned = [](const VerifyRow& row) { return is_loose(row) && !row.loose.empty(); };
  const auto controlled = [](const VerifyRow& row) { return !row.control && row.controlled; };
  const std::string all = count_of(rows, measure);
  return count_of(rows, is_loose) + " of " + all + " targets are more than three times the error, " +
         count_of(rows, reasoned) + " of them for a reason that the scene gives; " + count_of(rows, controlled) +
         " of " + all + " have a control that has to miss them";
}

std::string rows_csv(const Rows& rows) {
  std::string text =
      "case,what,result,unit,expected,kind,value,error,target,full_target,slack,order,least_order,order_is_judged,"
      "spacings_m,errors,wall_s,mpps,particles,steps,control,misses,met,source,shortfall,loose\n";
  for (const VerifyRow& row : rows) {
    const VariantRun& run = judged(row);
    text += quoted(row.scene) + "," + quoted(row.what) + "," + quoted(row.result) + "," + quoted(row.unit) + "," +
            format_number(row.expected) + "," +
            quoted(row.kind == ReferenceKind::regression ? "regression" : "reference") + "," +
            format_number(row.values.back()) + "," + format_number(row.errors.back()) + "," + format_number(row.bar) +
            "," + format_number(row.target) + "," + format_number(slack(row)) + "," + format_number(row.order) + "," +
            format_number(row.least_order) + "," + (row.judges_order ? "1" : "0") + "," + quoted(joined_spacings(row)) +
            "," + quoted(joined(row.errors, "nan")) + "," + format_number(wall_of(row)) + "," +
            format_number(run.mpps()) + "," + format_number(run.particles) + "," + format_number(run.steps) + "," +
            (row.control ? "1" : "0") + "," + quoted(row.misses) + "," + quoted(word_of(row.verdict)) + "," +
            quoted(row.source) + "," + quoted(row.shortfall) + "," + quoted(row.loose) + "\n";
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

std::string cases_markdown(const Rows& rows) {
  std::string table =
      "| case | measure nearest to its target | finest error | order | target | met | measures met | controls that "
      "fail "
      "|\n|---|---|---|---|---|---|---|---|\n";
  for (const CaseSummary& one : by_case(rows)) table += case_line(one);
  const auto shortfall = [](const VerifyRow& row) { return row.verdict == Verdict::guarded ? row.shortfall : ""; };
  return verify_totals(rows) + ".\n\n" + table + list_of(rows, "Known to be missed, and guarded", shortfall);
}

std::string rows_markdown(const Rows& rows) {
  std::string table =
      "| case | error of | reference | spacing [m] | errors | order | target | target over error | wall [s] | million "
      "particle-steps/s | met |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const VerifyRow& row : rows)
    table += "|" + cell(row.scene) + cell(row.what) + cell(reference_text(row)) + cell(joined_spacings(row)) +
             cell(joined(row.errors, "breaks")) + cell(order_text(row.order)) + cell(target_text(row)) +
             cell(slack_text(row)) + cell(format_number(wall_of(row), 2)) + cell(error_cell(judged(row).mpps())) +
             verdict_cell(row.verdict) + "\n";
  const auto loose = [](const VerifyRow& row) -> std::string {
    return !is_loose(row) ? "" : row.loose.empty() ? "no reason given" : row.loose;
  };
  const auto bare = [](const VerifyRow& row) { return std::string(row.controlled ? "" : "none"); };
  return slack_totals(rows) + ".\n\n" + table + list_of(rows, "Targets more than three times the error", loose) +
         list_of(rows, "Without a control that has to miss them", bare);
}

std::string rows_page(const Rows& rows, const std::string& page) {
  const std::string link = "[" + page + "](../" + page + ")";
  return "# Verification, row by row\n\nAll measures and controls of a run of `geodrop verify`, with the errors on "
         "each "
         "grid. " +
         link +
         " has one row for each case and explains the columns. Wall times are of all runs of a row, the "
         "speed is that of the last run. `geodrop verify --page` writes this page.\n\n" +
         rows_markdown(rows) + "\nWhere to go on: " + link + " for stability, bases, transfers and models.\n";
}

std::string with_generated_part(const std::string& page, const std::string& generated) {
  const std::string first = "<!-- geodrop verify -->\n", last = "<!-- end of geodrop verify -->";
  const std::size_t begin = page.find(first), end = page.find(last);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw RunError("the page has no lines \"<!-- geodrop verify -->\" and \"" + last + "\"");
  return page.substr(0, begin + first.size()) + generated + page.substr(end);
}

}  // namespace geodrop
