#include "result_list.hpp"

#include "output/text.hpp"

namespace geodrop {

std::vector<std::vector<std::string>> result_lines(const ResultList& results) {
  constexpr int digits = 10;
  std::vector<std::vector<std::string>> lines;
  for (const Result& result : results) lines.push_back({result.name, format_number(result.value, digits), result.unit});
  return lines;
}

std::string results_csv(const std::vector<ResultList>& rows) {
  constexpr int digits = 12;
  std::string header, text;
  for (const ResultList& row : rows) {
    std::string names, values;
    for (const Result& result : row) {
      names += (names.empty() ? "" : ",") + result.column;
      values += (values.empty() ? "" : ",") + format_number(result.value, digits);
    }
    header = names;
    text += values + "\n";
  }
  return header + "\n" + text;
}

}  // namespace geodrop
