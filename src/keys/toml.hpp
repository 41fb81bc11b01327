// toml++, always included through here.
#pragma once

// toml++ 3.3 asserts that a table header does not go on with "[[;" or "[[[", which is for the user to get wrong
// (toml++ pull request 301); without the assertion it reports a syntax error.
#define TOML_ASSERT(expression) static_assert(true)

#include <toml++/toml.h>
