// A page of gnuplot with places in pixels: views with equal scales side by side, legend or bars of colours on the
// right.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "picture_content.hpp"

namespace geodrop {

/// The place of a view.
struct Panel {
  Window window;
  PixelSize pixels;
  int left = 0;  ///< of the picture [px]
};

/// Everything that a page of gnuplot needs besides the pixels.
struct PictureLayout {
  std::vector<Panel> panels;  ///< a metre is as long in all of them
  int width = 0, height = 0;  ///< of the picture [px]
};

PictureLayout layout_of(const Extent& shown, const PictureContent& content);

/// What comes before the pages.
std::string page_opening(const std::string& terminal, const PictureLayout& layout,
                         const std::filesystem::path& picture);

/// `pixels`: files with those of each view.
std::string page_text(const Scene& scene, double t, const PictureContent& content, const PictureLayout& layout,
                      const std::vector<std::filesystem::path>& pixels);

}  // namespace geodrop
