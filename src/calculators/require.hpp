// How a closed form refuses a number that cannot be: by the name of its quantity.
#pragma once

#include <geodrop/base/error.hpp>

#include "base/text.hpp"

#include <cmath>
#include <string>

namespace geodrop {

struct Require {
  const char* formulas;  ///< what the message begins with

  /// Throws SceneError unless the condition holds and the number is finite.
  void operator()(bool good, const std::string& key, double found, const std::string& allowed) const {
    if (!good || !std::isfinite(found))
      throw SceneError(formulas, {{{}, key, format_number(found), allowed, ProblemSource::elsewhere}});
  }
};

}  // namespace geodrop
