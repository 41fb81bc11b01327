#include "surface_file.hpp"

#include <cstring>
#include <map>
#include <sstream>

namespace geodrop {
namespace {

/// Corners by their coordinates.
class CornerIndex {
 public:
  explicit CornerIndex(TriangleSurface& surface) : surface_(surface) {}
  std::uint32_t of(const Corner& x) {
    const auto [place, is_new] = index_.emplace(x, static_cast<std::uint32_t>(surface_.points.size()));
    if (is_new) surface_.points.push_back(x);
    return place->second;
  }

 private:
  TriangleSurface& surface_;
  std::map<Corner, std::uint32_t> index_;
};

SurfaceFromFile parse_stl_text(const std::string& content) {
  SurfaceFromFile out;
  CornerIndex corners(out.surface);
  std::istringstream text(content);
  std::array<std::uint32_t, 3> triangle{};
  std::size_t count = 0;
  for (std::string word; text >> word;) {
    if (word == "endfacet" && count != 3) {
      out.fault =
          "facet " + std::to_string(out.surface.triangles.size() + 1) + " of " + std::to_string(count) + " corners";
      return out;
    }
    if (word == "endfacet") {
      out.surface.triangles.push_back(triangle);
      count = 0;
    }
    if (word != "vertex") continue;
    Corner x;
    if (!(text >> x[0] >> x[1] >> x[2])) {
      out.fault = "a vertex without three numbers in facet " + std::to_string(out.surface.triangles.size() + 1);
      return out;
    }
    if (count < 3) triangle[count] = corners.of(x);
    ++count;
  }
  if (out.surface.triangles.empty()) out.fault = "no facet";
  return out;
}

/// 80 bytes of title, the number of triangles, and 50 bytes for each: normal, three corners, two bytes of nothing.
constexpr std::size_t stl_title = 80, stl_head = 84, stl_triangle = 50, stl_normal = 12;

std::uint32_t stl_count(const std::string& content) {
  std::uint32_t count = 0;
  if (content.size() >= stl_head) std::memcpy(&count, content.data() + stl_title, sizeof count);
  return count;
}

SurfaceFromFile parse_stl_binary(const std::string& content) {
  SurfaceFromFile out;
  CornerIndex corners(out.surface);
  for (std::uint32_t t = 0; t < stl_count(content); ++t) {
    std::array<std::uint32_t, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<float, 3> x;
      std::memcpy(x.data(), content.data() + stl_head + t * stl_triangle + stl_normal + k * sizeof x, sizeof x);
      triangle[k] = corners.of({x[0], x[1], x[2]});
    }
    out.surface.triangles.push_back(triangle);
  }
  return out;
}

}  // namespace

SurfaceFromFile parse_stl(const std::string& content) {
  const bool binary =
      content.size() >= stl_head && content.size() == stl_head + stl_triangle * std::size_t{stl_count(content)};
  return binary ? parse_stl_binary(content) : parse_stl_text(content);
}

SurfaceFromFile parse_obj(const std::string& content) {
  SurfaceFromFile out;
  std::istringstream text(content);
  std::size_t number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    const auto refuse = [&](const std::string& what) { out.fault = what + " in line " + std::to_string(number); };
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Corner x;
      if (!(words >> x[0] >> x[1] >> x[2])) return refuse("a corner without three numbers"), out;
      out.surface.points.push_back(x);
    }
    if (word != "f") continue;
    std::vector<std::uint32_t> face;
    for (std::string corner; words >> corner;) {
      const long index = std::strtol(corner.c_str(), nullptr, 10);  // "7/1/3": the corner comes first
      const long place = index < 0 ? static_cast<long>(out.surface.points.size()) + index : index - 1;
      if (place < 0 || place >= static_cast<long>(out.surface.points.size()))
        return refuse("a corner that is not there, " + corner), out;
      face.push_back(static_cast<std::uint32_t>(place));
    }
    if (face.size() < 3) return refuse("a face of " + std::to_string(face.size()) + " corners"), out;
    for (std::size_t k = 1; k + 1 < face.size(); ++k) out.surface.triangles.push_back({face[0], face[k], face[k + 1]});
  }
  if (out.surface.triangles.empty()) out.fault = "no face";
  return out;
}

}  // namespace geodrop
