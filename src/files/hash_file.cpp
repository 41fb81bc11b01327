#include "hash_file.hpp"

#include "base/atomic_file.hpp"
#include "base/text.hpp"

#include <fstream>
#include <sstream>

namespace geodrop {
namespace {

constexpr std::size_t hash_digits = 16;
constexpr int exact_digits = 17;

std::string line_of(const HashRow& row) {
  return format_number(row.t, exact_digits) + "," + std::to_string(row.step) + "," + row.hash + "\n";
}

/// Leaves the rows up to a time. Atomically: killed in between, a run still has what it goes on from.
const std::filesystem::path& cut_back(const std::filesystem::path& path, double kept_until) {
  std::string text = "time_s,step,hash\n";
  for (const HashRow& row : read_hashes(path))
    if (row.t <= kept_until) text += line_of(row);
  write_file_atomically(path, text);
  return path;
}

}  // namespace

std::vector<HashRow> read_hashes(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<HashRow> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    HashRow row;
    char comma = 0, second_comma = 0;
    if (cells >> row.t >> comma >> row.step >> second_comma >> row.hash && row.hash.size() == hash_digits)
      rows.push_back(row);
  }
  return rows;
}

HashFile::HashFile(const std::filesystem::path& path, double kept_until)
    : file_(cut_back(path, kept_until), GrowingFile::Begin::behind) {}

void HashFile::append(const HashRow& row) { file_.append(line_of(row)); }

}  // namespace geodrop
