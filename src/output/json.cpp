#include "json.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "text.hpp"

namespace geodrop {
namespace {

std::string move_in(const std::string& json) {
  std::string moved;
  for (const char c : json) moved += c == '\n' ? std::string("\n  ") : std::string(1, c);
  return moved;
}

std::string member(const std::pair<std::string, std::string>& member) {
  return json_text(member.first) + ": " + member.second;
}

std::string lines(const std::vector<std::string>& items, char open, char close) {
  std::string text(1, open);
  for (std::size_t i = 0; i < items.size(); ++i) text += (i == 0 ? "\n  " : ",\n  ") + move_in(items[i]);
  if (!items.empty()) text += "\n";
  return text + close;
}

}  // namespace

std::string json_text(const std::string& text) {
  std::string json = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      json += '\\';
      json += c;
    } else if (c == '\n') {
      json += "\\n";
    } else if (c == '\t') {
      json += "\\t";
    } else if (code < 0x20) {
      std::array<char, 8> escape;
      std::snprintf(escape.data(), escape.size(), "\\u%04x", static_cast<unsigned>(code));
      json += escape.data();
    } else {
      json += c;
    }
  }
  return json + '"';
}

std::string json_number(double value) {
  constexpr int digits = 12;
  return std::isfinite(value) ? format_number(value, digits) : "null";
}

std::string json_object(const std::vector<std::pair<std::string, std::string>>& members) {
  std::vector<std::string> items;
  for (const auto& each : members) items.push_back(member(each));
  return lines(items, '{', '}');
}

std::string json_array(const std::vector<std::string>& items) { return lines(items, '[', ']'); }

std::string json_record(const std::vector<std::pair<std::string, std::string>>& members) {
  std::string text = "{";
  for (std::size_t i = 0; i < members.size(); ++i) text += (i == 0 ? "" : ", ") + member(members[i]);
  return text + "}";
}

}  // namespace geodrop
