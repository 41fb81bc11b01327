// hashes.csv: the hash of the state at each row of history.csv, for `geodrop replay` and for comparing two runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/growing_file.hpp"

namespace geodrop {

inline constexpr const char* hashes_name = "hashes.csv";

struct HashRow {
  double t = 0;  ///< [s]
  std::uint64_t step = 0;
  std::string hash;  ///< see state_hash
};

/// All whole rows; none if there is no such file.
std::vector<HashRow> read_hashes(const std::filesystem::path& path);

/// Writes rows as they come. What the disk does not take is tried again with the next row: history.csv, which is
/// written at the same times, is where it is reported.
class HashFile {
 public:
  /// Keeps the rows that are there up to time `kept_until` [s]. Throws WriteError.
  HashFile(const std::filesystem::path& path, double kept_until);
  void append(const HashRow& row);
  /// Tries again to write rows that the disk did not take.
  void catch_up() { file_.append(""); }

 private:
  GrowingFile file_;
};

}  // namespace geodrop
