#include "result_list.hpp"

#include "base/text.hpp"

#include <geodrop/base/error.hpp>

#include <cmath>

namespace geodrop {
namespace {

/// Inputs near the ends of the range of numbers give results beyond them.
[[noreturn]] void refuse(const ListedNumber& result) {
  throw SceneError("geodrop", {{{},
                                result.name,
                                "a result beyond the range of numbers",
                                "inputs of sizes that occur",
                                ProblemSource::elsewhere}});
}

}  // namespace

std::vector<std::vector<std::string>> result_lines(const ResultList& results) {
  std::vector<std::vector<std::string>> lines;
  for (const ListedNumber& result : results) {
    if (!std::isfinite(result.value)) refuse(result);
    lines.push_back({result.name, short_number(result.value), result.unit});
  }
  return lines;
}

std::string row_table(const std::vector<ResultList>& rows, const std::string& no_number) {
  std::vector<std::vector<std::string>> lines{{}, {}};
  for (const ListedNumber& result : rows.front()) {
    lines[0].push_back(result.name);
    lines[1].push_back("[" + result.unit + "]");
  }
  for (const ResultList& row : rows) {
    lines.emplace_back();
    for (const ListedNumber& result : row) {
      if (std::isinf(result.value)) refuse(result);
      lines.back().push_back(std::isnan(result.value) ? no_number : short_number(result.value));
    }
  }
  return format_table(lines, std::string(lines[0].size(), 'r'));
}

std::string results_csv(const std::vector<ResultList>& rows) {
  constexpr int digits = 12;
  std::string header, text;
  for (const ResultList& row : rows) {
    std::string names, values;
    for (const ListedNumber& result : row) {
      names += (names.empty() ? "" : ",") + result.column;
      values += (values.empty() ? "" : ",") + format_number(result.value, digits);
    }
    header = names;
    text += values + "\n";
  }
  return header + "\n" + text;
}

}  // namespace geodrop
