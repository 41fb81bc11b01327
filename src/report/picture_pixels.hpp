// The pixels of a view: particles as discs within their membranes, or the foremost triangles of membranes.
#pragma once

#include <string>

#include "picture_content.hpp"
#include "picture_page.hpp"

namespace geodrop {

/// Bytes as of draw_discs.
std::string pixels_of(const Scene& scene, const PaintedView& painted, const Panel& panel);

}  // namespace geodrop
