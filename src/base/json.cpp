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

/// Bytes of the UTF-8 letter at `at`; 0 if there is none (RFC 3629: no overlong forms, no surrogates, none beyond
/// U+10FFFF). Names of files may hold any bytes.
std::size_t letter_bytes(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return at + k < text.size() ? static_cast<unsigned char>(text[at + k]) : 0U; };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  const std::size_t count = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  for (std::size_t k = 1; k < count; ++k)
    if ((byte(k) & 0xC0) != 0x80) return 0;
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool beyond = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return overlong || beyond ? 0 : count;
}

}  // namespace

std::string json_text(const std::string& text) {
  std::string json = "\"";
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::size_t bytes = letter_bytes(text, at);
    if (bytes != 1) {
      json += bytes == 0 ? "\\ufffd" : text.substr(at, bytes);
      at += bytes == 0 ? 0 : bytes - 1;
      continue;
    }
    const char c = text[at];
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

std::string json_texts(const std::vector<std::string>& texts) {
  std::vector<std::string> items;
  for (const std::string& text : texts) items.push_back(json_text(text));
  return json_array(items);
}

std::string json_record(const std::vector<std::pair<std::string, std::string>>& members) {
  std::string text = "{";
  for (std::size_t i = 0; i < members.size(); ++i) text += (i == 0 ? "" : ", ") + member(members[i]);
  return text + "}";
}

}  // namespace geodrop
