// Samples of uncertain inputs, and what their results say.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace geodrop {

/// A key of the scene, or several joined by + that have the same value, and the range that it is drawn from, evenly.
struct Variation {
  std::string key;
  double low = 0, high = 0;
  bool whole = false;       ///< both ends were written as whole numbers
  bool by_factors = false;  ///< the logarithm is drawn evenly
  bool operator==(const Variation&) const = default;
};

/// The number that a text is as a whole, if it is one and finite.
std::optional<double> number_in(const std::string& text);

/// Whether a number is written without point and exponent.
bool is_whole(const std::string& text);

/// Of "KEY=LOW:HIGH", or "KEY=LOW:HIGH:log" by factors; throws SceneError if it is anything else or LOW > HIGH.
Variation parse_variation(const std::string& text);

/// Values by sample and key. Latin hypercube (McKay, Beckman & Conover 1979): of each key one value in each of as many
/// equal parts of its range as there are samples, in random order. The same on every machine for a seed.
std::vector<std::vector<double>> latin_hypercube(const std::vector<Variation>& variations, int samples,
                                                 std::uint64_t seed);

/// The value as --set takes it, in as few digits as tell it from its neighbours.
std::string value_text(const Variation& variation, double value);

/// "KEY=LOW:HIGH", as parse_variation takes it.
std::string variation_text(const Variation& variation);

/// Those of all samples, by key.
std::vector<std::vector<std::string>> value_texts(const std::vector<Variation>& variations,
                                                  const std::vector<std::vector<double>>& values);

/// All keys at the low end, then all at the high one: what a scene refuses is found before the first run.
std::vector<std::vector<std::string>> ends_of(const std::vector<Variation>& variations);

/// Median, and the values that 5 and 95 % lie below, by linear interpolation between the sorted values.
struct Band {
  double low, median, high;
};
/// Of values that are finite; nan if there are none.
Band band_of(std::vector<double> values);

/// Spearman's rank correlation of the pairs of which both are finite; equal values share their mean rank. 0 if either
/// is the same everywhere, nan for fewer than three pairs.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace geodrop
