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

/// The title of a view: over its middle, or from its left edge on where it is too long for that, in two lines where it
/// is too long for the picture.
std::string title_text(const std::string& title, const Panel& panel, const PictureLayout& layout);

/// What comes before the pages.
std::string page_opening(const std::string& terminal, const PictureLayout& layout,
                         const std::filesystem::path& picture);

/// `pixels`: files with those of each view.
std::string page_text(const Scene& scene, double t, const PictureContent& content, const PictureLayout& layout,
                      const std::vector<std::filesystem::path>& pixels);

}  // namespace geodrop
