#include "html.hpp"

#include <algorithm>
#include <cstdint>

#include "base/atomic_file.hpp"

namespace geodrop::html {
namespace {

constexpr const char* style = R"(
body { font: 15px/1.45 "DejaVu Sans", Verdana, sans-serif; color: #1a1a1a; max-width: 62em; margin: 2em auto; padding: 0 1.5em; }
h1 { font-size: 1.6em; margin-bottom: 0.2em; }
h2 { font-size: 1.15em; margin-top: 2em; border-bottom: 1px solid #b0b0b0; padding-bottom: 0.15em; }
p.question { font-size: 1.1em; margin-top: 0; }
pre.comment { white-space: pre-wrap; font: 0.82em/1.4 "DejaVu Sans Mono", monospace; background: #f5f5f5; padding: 0.8em; }
table { border-collapse: collapse; margin: 0.8em 0; font-size: 0.92em; }
th, td { text-align: left; padding: 0.2em 0.9em 0.2em 0; border-bottom: 1px solid #dddddd; vertical-align: top; }
th { border-bottom: 1px solid #707070; }
td.number, th.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
.yes { color: #00703c; } .no { color: #b00020; font-weight: bold; }
.warning { background: #fff3d6; border-left: 4px solid #d08a00; padding: 0.5em 0.9em; margin: 0.4em 0; }
figure { margin: 1em 0; break-inside: avoid; } figure img, figure svg { max-width: 100%; height: auto; }
figcaption { font-size: 0.88em; color: #444444; }
code { font: 0.92em "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
@page { size: A4; margin: 15mm; }
@media print {
  body { margin: 0; max-width: none; padding: 0; font-size: 11px; } h2 { break-after: avoid; } tr { break-inside: avoid; }
  figure { margin: 0.5em 0; } figure.picture img { max-height: 11.8cm; } figure.drawing img { max-height: 23cm; }
}
)";

/// An image within the page; kind "picture": two fit on a printed page, "drawing": one.
std::string figure(const std::string& kind, const std::string& type, const std::filesystem::path& file,
                   const std::string& caption) {
  return "<figure class=\"" + kind + "\"><img alt=\"" + text(caption) + "\" src=\"data:image/" + type + ";base64," +
         base64(text_of_file(file)) + "\"><figcaption>" + text(caption) + "</figcaption></figure>\n";
}

}  // namespace

std::string text(const std::string& plain) {
  std::string html;
  for (const char letter : plain) {
    switch (letter) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += letter;
    }
  }
  return html;
}

std::string table(const std::vector<std::vector<std::string>>& lines, const std::vector<std::size_t>& numbers) {
  std::string html = "<table>\n";
  for (const auto& line : lines) {
    const std::string tag = &line == &lines.front() ? "th" : "td";
    html += "<tr>";
    for (std::size_t c = 0; c < line.size(); ++c) {
      const bool number = std::ranges::find(numbers, c) != numbers.end();
      html += "<" + tag + (number ? " class=\"number\">" : ">") + line[c] + "</" + tag + ">";
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

std::string base64(const std::string& bytes) {
  constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) result += i + k <= bytes.size() ? letters[group >> (18U - 6U * k) & 63U] : '=';
  }
  return result;
}

std::string picture(const std::filesystem::path& png, const std::string& caption) {
  return figure("picture", "png", png, caption);
}

std::string drawing(const std::filesystem::path& svg, const std::string& caption) {
  // As an image: names inside a drawing would be those of the whole page otherwise.
  return figure("drawing", "svg+xml", svg, caption);
}

std::string page(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" + text(title) +
         "</title>\n<style>" + style + "</style>\n</head>\n<body>\n" + body + "</body>\n</html>\n";
}

}  // namespace geodrop::html
