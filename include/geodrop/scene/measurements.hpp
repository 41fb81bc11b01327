// What a scene makes of its measurements: results, expectations, verification.
#pragma once

#include <geodrop/base/error.hpp>

#include <limits>
#include <string>
#include <vector>

namespace geodrop {

/// How a column of history.csv becomes one number.
enum class Reduction {
  last,
  min,
  max,
  mean,
  rms,
  percentile,
  period,
  first_time_below,
  rms_difference,
  r_squared,
  slope
};

/// A named result of the run: `reduce` applied to `column` over rows with from <= t <= to, times `scale`.
struct ResultSpec {
  std::string name;    ///< ends in its unit, e.g. fall_velocity_max_m_s
  std::string column;  ///< of history.csv
  Reduction reduce = Reduction::last;
  double from = 0;                                      ///< [s]
  double to = std::numeric_limits<double>::infinity();  ///< [s]; infinite: to the end of the run
  std::string after, before;                            ///< results, times that narrow the window; empty: none
  double scale = 1;
  double percentile = 0;       ///< [0..100], for Reduction::percentile
  double level = 0;            ///< for Reduction::first_time_below
  std::string against;         ///< other column, for r_squared
  std::vector<double> times;   ///< for rms_difference: compare at these times [s]
  std::vector<double> values;  ///< ... with these values
  SourceRef at;
  bool operator==(const ResultSpec&) const = default;
};
/// An expectation that a run prints beside its result; met if |value - expected| <= tolerance.
struct ExpectSpec {
  std::string result;
  double expected = 0;
  double tolerance = 0;
  std::string source;
  SourceRef at;
  bool operator==(const ExpectSpec&) const = default;
};

/// What an expected value is: a closed form, a published value or an independent computation; or a result of the code
/// itself, which can show that something has changed and no more.
enum class ReferenceKind { reference, regression };

/// What `geodrop verify` judges a scene by: a result beside its reference.
struct VerifySpec {
  std::string result;
  std::string over;     ///< another result that the value is divided by; empty: none
  std::string what;     ///< in words, with the unit of the error
  double expected = 0;  ///< in the unit of the result, or of the quotient
  ReferenceKind kind = ReferenceKind::reference;
  double scale = 0;         ///< the error is |value - expected| over this; 0: over |expected|
  double target = 0;        ///< largest error of the last variant of a full verification
  double quick_target = 0;  ///< of a quick one, which stops at a coarser grid; 0: the same
  double least_order = 0;   ///< of the error over all variants against the grid spacing; 0: none is asked for
  std::string source;
  std::string shortfall;  ///< why the target is known to be missed; empty: it is not
  double guard = 0;       ///< largest error that a known miss may have; 0 without a shortfall
  std::string loose;      ///< why the target is more than three times the error; empty: it is not
  SourceRef at;
  bool operator==(const VerifySpec&) const = default;
};
/// When `geodrop verify` runs a variant.
enum class VerifyMode { quick, full, both };

/// A run that `geodrop verify` makes of the scene.
struct VariantSpec {
  std::string name;
  std::vector<std::string> set;  ///< overrides, each as after --set
  VerifyMode in = VerifyMode::both;
  bool control = false;  ///< broken on purpose: has to miss a target
  std::vector<std::string>
      of;              ///< results whose targets a control has to miss, each; empty: that of the only [[verify]]
  std::string breaks;  ///< part of the message that a control has to break with; empty: it has to run to its end
  SourceRef at;
  bool operator==(const VariantSpec&) const = default;
};

}  // namespace geodrop
