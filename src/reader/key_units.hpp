// Units of keys, without the table of them.
#pragma once

#include <string_view>

namespace geodrop {

/// Of the value that a full key leads to, where names stand for the elements of lists: "m" of "grid.spacing", "degree"
/// of "bodies.bag.shape.tilt_deg". Empty if it has none, or keys of this name have several, or there is no such key.
std::string_view unit_of_path(std::string_view path);

}  // namespace geodrop
