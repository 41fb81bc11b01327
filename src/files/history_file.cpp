#include "history_file.hpp"

#include "base/atomic_file.hpp"
#include "base/text.hpp"

namespace geodrop {
namespace {

template <class Values, class Write>
std::string line(const Values& values, const Write& write) {
  std::string text;
  for (const auto& value : values) text += (text.empty() ? "" : ",") + write(value);
  return text + "\n";
}

std::string row_text(const std::vector<double>& row) {
  return line(row, [](double value) { return format_number(value); });
}

const std::filesystem::path& write_table(const std::filesystem::path& path, const HistoryTable& table) {
  std::string text = line(table.columns, [](const std::string& name) { return name; });
  for (const std::vector<double>& row : table.rows) text += row_text(row);
  write_file_atomically(path, text);
  return path;
}

}  // namespace

HistoryFile::HistoryFile(const std::filesystem::path& path, const HistoryTable& table)
    : file_(write_table(path, table), GrowingFile::Begin::behind) {}

void HistoryFile::append(const std::vector<double>& row) { file_.append(row_text(row)); }

}  // namespace geodrop
