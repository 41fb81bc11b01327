// The main function of the one test binary.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <csignal>

#include "support/not_tested.hpp"

int main(int count, char** words) {
  std::signal(SIGHUP, SIG_DFL);  // nohup ignores it, which programs of the tests would inherit
  const int result = doctest::Context(count, words).run();
  constexpr int skipped = 77;  // as ctest is told
  return result == 0 && geodrop::test::something_not_tested ? skipped : result;
}
