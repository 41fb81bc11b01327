// A table of numbers as the program writes them: a header of names, then rows.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace geodrop {

struct CsvTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  ///< as many as names, all of one length

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  bool has(const std::string& name) const { return std::ranges::find(names, name) != names.end(); }
  /// Throws SceneError if there is no such column.
  const std::vector<double>& column(const std::string& name) const;
  std::string file = {};  ///< for messages
};

struct TextTable {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;  ///< each as wide as the names
  std::string file = {};
};

/// Cells as they are, without the quotes around those that hold commas. Throws SceneError if there is no such file,
/// with `what` as what is allowed, or a row is not as wide as the header.
TextTable read_text_table(const std::filesystem::path& file, const std::string& what);

/// A row that is still being written, or was when its run was killed, has no end of line.
enum class LastRow { any, whole };

/// Throws SceneError with line and column where a cell is no number, or a row is not as wide as the header.
CsvTable read_csv(const std::filesystem::path& file, LastRow last = LastRow::any);

}  // namespace geodrop
