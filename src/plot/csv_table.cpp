#include "csv_table.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/base/input_file.hpp>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace geodrop {
namespace {

/// Commas within quotes are of the cell.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> list{""};
  bool quoted = false;
  for (const char letter : line) {
    if (letter == '"')
      quoted = !quoted;
    else if (letter == ',' && !quoted)
      list.emplace_back();
    else if (letter != '\r')
      list.back() += letter;
  }
  return list;
}

}  // namespace

const std::vector<double>& CsvTable::column(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw SceneError(file, {{{1, 1}, "", "no column " + name, "a table with this column", ProblemSource::elsewhere}});
  return columns[static_cast<std::size_t>(found - names.begin())];
}

TextTable read_text_table(const std::filesystem::path& path, const std::string& what) {
  std::istringstream file(read_input(path, "", what));
  std::string line;
  std::getline(file, line);
  TextTable table{cells(line), {}, path.string()};
  for (int number = 2; std::getline(file, line); ++number) {
    table.rows.push_back(cells(line));
    if (table.rows.back().size() != table.names.size())
      throw SceneError(path.string(), {{{number, 1},
                                        "",
                                        std::to_string(table.rows.back().size()) + " cells",
                                        std::to_string(table.names.size()) + ", as the header has",
                                        ProblemSource::elsewhere}});
  }
  return table;
}

CsvTable read_csv(const std::filesystem::path& path, LastRow last) {
  constexpr std::uint64_t most = std::uint64_t{4} << 30;
  std::string text = read_input(path, "", "a table of numbers", most);
  if (last == LastRow::whole) text.resize(text.rfind('\n') + 1);
  std::istringstream file(std::move(text));
  std::string line;
  std::getline(file, line);
  CsvTable table{cells(line), {}, path.string()};
  table.columns.resize(table.names.size());
  for (int number = 2; std::getline(file, line); ++number) {
    const auto refuse = [&, row = number](std::size_t column, const std::string& found, const std::string& allowed) {
      throw SceneError(path.string(),
                       {{{row, static_cast<int>(column) + 1}, "", found, allowed, ProblemSource::elsewhere}});
    };
    const std::vector<std::string> row = cells(line);
    if (row.size() != table.names.size())
      refuse(0, std::to_string(row.size()) + " cells", std::to_string(table.names.size()) + ", as the header has");
    std::size_t position = 0;
    for (std::size_t c = 0; c < row.size(); ++c) {
      char* end = nullptr;
      table.columns[c].push_back(std::strtod(row[c].c_str(), &end));
      if (row[c].empty() || *end != '\0') refuse(position, "\"" + row[c] + "\"", "a number");
      position += row[c].size() + 1;
    }
  }
  return table;
}

}  // namespace geodrop
