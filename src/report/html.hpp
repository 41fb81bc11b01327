// The little HTML that a report needs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace geodrop::html {

/// With what HTML would take for its own replaced.
std::string text(const std::string& plain);

/// Cells are HTML already; the first line is the head. `numbers`: of columns, counted from 0, that stand on the right.
std::string table(const std::vector<std::vector<std::string>>& lines, const std::vector<std::size_t>& numbers);

/// A PNG within the page, with a caption.
std::string picture(const std::filesystem::path& png, const std::string& caption);

/// An SVG within the page.
std::string drawing(const std::filesystem::path& svg, const std::string& caption);

/// The bytes in letters (RFC 4648).
std::string base64(const std::string& bytes);

/// A whole page around a body, with its style.
std::string page(const std::string& title, const std::string& body);

}  // namespace geodrop::html
