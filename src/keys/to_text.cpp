#include "to_text.hpp"

#include <charconv>
#include <sstream>

namespace geodrop {
namespace {

/// A basic TOML string, in one line.
std::string quote(const std::string& word) {
  std::string text = "\"";
  for (const char c : word) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      text += {'\\', c};
    } else if (code < 0x20 || code == 0x7f) {
      constexpr const char* digits = "0123456789ABCDEF";
      text += std::string("\\u00") + digits[code / 16] + digits[code % 16];
    } else {
      text += c;
    }
  }
  return text + '"';
}

}  // namespace

std::string to_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end.ptr};
}

std::string to_text(const Point& point) {
  std::string text = "[";
  for (std::size_t i = 0; i < point.size(); ++i) text += (i > 0 ? ", " : "") + to_text(point[i]);
  return text + "]";
}

std::string to_text(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_floating_point()) return to_text(node.as_floating_point()->get());
  std::string text;
  if (const toml::array* list = node.as_array()) {
    for (const toml::node& element : *list) text += (text.empty() ? "" : ", ") + to_text(element);
    return "[" + text + "]";
  }
  if (const auto* word = node.as_string()) return quote(word->get());
  std::ostringstream stream;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>) stream << value;
  });
  return stream.str();
}

}  // namespace geodrop
