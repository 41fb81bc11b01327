// The values of a sweep: keys of the scene and what they are in turn.
#pragma once

#include <string>
#include <vector>

namespace geodrop {

/// A key of the scene and the values that it takes in turn, as --set takes them.
struct Axis {
  std::string key;
  std::vector<std::string> values;
  bool operator==(const Axis&) const = default;
};

/// Of "KEY=A:B:N", N values from A to B evenly, "KEY=A:B:N:log", by equal factors, or "KEY=A,B,C", words as well.
/// Throws SceneError if it is anything else.
Axis parse_axis(const std::string& text);

/// All combinations; the last key changes fastest.
std::vector<std::vector<std::string>> combinations(const std::vector<Axis>& axes);

}  // namespace geodrop
