// What tests of closed forms share.
#pragma once

#include <geodrop/base/error.hpp>

#include <doctest/doctest.h>

#include <functional>
#include <string>

namespace geodrop::test {

/// A formula that is given what cannot be says so.
inline void check_refused(const std::function<double()>& formula, const std::string& says) {
  std::string said;
  try {
    formula();
  } catch (const SceneError& error) {
    said = error.what();
  }
  CAPTURE(said);
  CHECK(said.find(says) != std::string::npos);
}

}  // namespace geodrop::test
