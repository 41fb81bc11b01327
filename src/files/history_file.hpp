// history.csv on the disk.
#pragma once

#include <filesystem>
#include <geodrop/measure/history.hpp>
#include <string>
#include <vector>

#include "base/growing_file.hpp"

namespace geodrop {

/// Writes rows as they come, each at once, with nine digits.
class HistoryFile {
 public:
  /// Writes the header and all rows of `table` anew; an earlier file stays until they are on the disk. Throws
  /// WriteError.
  HistoryFile(const std::filesystem::path& path, const HistoryTable& table);
  void append(const std::vector<double>& row);
  /// Tries again to write rows that the disk did not take.
  void catch_up() { file_.append(""); }
  const std::string& failure() const { return file_.failure(); }

 private:
  GrowingFile file_;
};

}  // namespace geodrop
