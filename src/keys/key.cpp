#include "key.hpp"

namespace geodrop {

std::string join_path(std::string_view parent, std::string_view child) {
  std::string path(parent);
  if (!path.empty()) path += '.';
  return path.append(child);
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.emplace_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

}  // namespace geodrop
