// The main function of the one test binary.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <csignal>

int main(int count, char** words) {
  std::signal(SIGHUP, SIG_DFL);  // nohup ignores it, which programs of the tests would inherit
  return doctest::Context(count, words).run();
}
