#include "machine.hpp"

#include <algorithm>
#include <fstream>

namespace geodrop {
namespace {

/// Text after the colon of the first line of a file of /proc that starts with `key`.
std::string proc_entry(const std::string& file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (const std::size_t colon = line.find(':'); line.starts_with(key) && colon != std::string::npos) {
      const std::size_t text = line.find_first_not_of(" \t", colon + 1);
      return text == std::string::npos ? "" : line.substr(text);
    }
  return "";
}

/// In this directory or one above it, or in share/geodrop there; empty if there is none.
std::filesystem::path find_upwards(std::filesystem::path start, const std::filesystem::path& relative) {
  std::error_code none;
  for (;; start = start.parent_path()) {
    for (const std::filesystem::path& root : {start, start / "share" / "geodrop"})  // as it is installed
      if (std::filesystem::exists(root / relative, none)) return root / relative;
    if (start == start.parent_path()) return {};
  }
}

}  // namespace

std::string processor_name() {
  std::string name = proc_entry("/proc/cpuinfo", "model name");
  std::replace(name.begin(), name.end(), ',', ' ');
  return name.empty() ? "unknown" : name;
}

double available_memory() {
  constexpr double kibibyte = 1024;
  const std::string text = proc_entry("/proc/meminfo", "MemAvailable");
  return text.empty() ? 0 : std::stod(text) * kibibyte;
}

std::filesystem::path find_in_tree(const std::filesystem::path& relative) {
  std::error_code none;
  const std::filesystem::path found = find_upwards(std::filesystem::current_path(none), relative);
  return found.empty() ? find_beside_program(relative) : found;
}

std::filesystem::path find_beside_program(const std::filesystem::path& relative) {
  std::error_code none;
  return find_upwards(std::filesystem::read_symlink("/proc/self/exe", none).parent_path(), relative);
}

}  // namespace geodrop
