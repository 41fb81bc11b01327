// What a machine lacks is reported: a test that could not look at something ends as skipped, not as passed.
#pragma once

#include <doctest/doctest.h>

#include <string>

namespace geodrop::test {

/// Whether a test case of this process could not be tried here.
inline bool something_not_tested = false;

/// To be called before such a test case returns.
inline void not_tested(const std::string& why) {
  something_not_tested = true;
  MESSAGE("not tested: " << why);
}

}  // namespace geodrop::test
