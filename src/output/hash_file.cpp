#include "hash_file.hpp"

#include "text.hpp"

#include <fstream>
#include <sstream>
#include <utility>

namespace geodrop {
namespace {

constexpr std::size_t hash_digits = 16;
constexpr int exact_digits = 17;

std::string line_of(const HashRow& row) {
  return format_number(row.t, exact_digits) + "," + std::to_string(row.step) + "," + row.hash + "\n";
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

HashFile::HashFile(std::filesystem::path path, double kept_until)
    : path_(std::move(path)), text_("time_s,step,hash\n") {
  for (const HashRow& row : read_hashes(path_))
    if (row.t <= kept_until) text_ += line_of(row);
  std::ofstream(path_, std::ios::trunc);
}

void HashFile::append(const HashRow& row) {
  text_ += line_of(row);
  std::ofstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(written_));
  file.write(text_.data() + written_, static_cast<std::streamsize>(text_.size() - written_));
  if (file.flush()) written_ = text_.size();
}

}  // namespace geodrop
