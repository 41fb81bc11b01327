// Closed surfaces from files of other programs.
#pragma once

#include <geodrop/geometry/triangle_surface.hpp>

#include <string>

namespace geodrop {

/// A surface or what is wrong with the file.
struct SurfaceFromFile {
  TriangleSurface surface;
  std::string fault;  ///< "" if there is none
};

/// The content of an STL file (text or binary) or of an OBJ file (`v` and `f`, polygons are divided into fans). Corners
/// of STL are one where they have the same coordinates to the last bit.
SurfaceFromFile parse_stl(const std::string& content);
SurfaceFromFile parse_obj(const std::string& content);

}  // namespace geodrop
