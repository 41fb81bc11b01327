// Looking things up by their name, where it is known that they are there.
#pragma once

#include <algorithm>
#include <cassert>
#include <string>

namespace geodrop {

template <class List>
bool is_named(const List& list, const std::string& name) {
  return std::any_of(list.begin(), list.end(), [&](const auto& item) { return item.name == name; });
}

/// The first of a list with this name; there has to be one.
template <class List>
auto& find_named(List& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& item) { return item.name == name; });
  assert(found != list.end());
  return *found;
}

/// Null if the list has none of this name.
template <class List>
auto find_or_null(List& list, const std::string& name) -> decltype(&*list.begin()) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& each) { return each.name == name; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace geodrop
