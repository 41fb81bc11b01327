#include "samples.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/measure/measure.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <random>

#include "keys/key.hpp"
#include "measure/series.hpp"

namespace geodrop {
namespace {

/// From 0 to below 1, by the 53 highest bits: the same on every machine, unlike std::uniform_real_distribution.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (std::size_t i = first; i < end; ++i) ranks[order[i]] = 0.5 * static_cast<double>(first + end - 1);
  }
  return ranks;
}

/// `share` of the range from its low end, 0 to below 1.
double value_at(const Variation& range, double share) {
  if (range.by_factors) return range.low * std::pow(range.high / range.low, share);
  if (range.whole) return std::floor(range.low + share * (range.high - range.low + 1));
  return range.low + share * (range.high - range.low);
}

}  // namespace

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

bool is_whole(const std::string& text) { return text.find_first_not_of("+-0123456789") == std::string::npos; }

Variation parse_variation(const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::vector<std::string> ends = split(text.substr(std::min(equals + 1, text.size())), ':');
  const bool by_factors = ends.size() == 3 && ends[2] == "log";
  if (equals > 0 && (ends.size() == 2 || by_factors)) {
    const auto from = number_in(ends[0]), to = number_in(ends[1]);
    const bool whole = is_whole(ends[0]) && is_whole(ends[1]) && !by_factors;
    if (from && to && *from <= *to && !(by_factors && *from <= 0))
      return {text.substr(0, equals), *from, *to, whole, by_factors};
  }
  throw SceneError("--vary", {{{},
                               "",
                               '"' + text + '"',
                               "KEY=LOW:HIGH, two numbers in order (with :log after them two above 0), e.g. "
                               "bodies.bag.shape.tilt_deg=0.0:15.0",
                               ProblemSource::elsewhere}});
}

std::vector<std::vector<double>> latin_hypercube(const std::vector<Variation>& variations, int samples,
                                                 std::uint64_t seed) {
  const auto count = static_cast<std::size_t>(samples);
  std::vector<std::vector<double>> values(count, std::vector<double>(variations.size()));
  for (std::size_t v = 0; v < variations.size(); ++v) {
    std::mt19937_64 random(seed * 1000003 + v);  // of its own: one key more leaves the values of the others
    std::vector<std::size_t> part(count);
    std::iota(part.begin(), part.end(), std::size_t{0});
    for (std::size_t i = count; i-- > 1;) std::swap(part[i], part[random() % (i + 1)]);
    for (std::size_t i = 0; i < count; ++i)
      values[i][v] = value_at(variations[v], (static_cast<double>(part[i]) + uniform(random)) / samples);
  }
  return values;
}

std::string value_text(const Variation& variation, double value) {
  if (variation.whole) return std::to_string(static_cast<long long>(value));
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  std::string text(digits.data(), end);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string variation_text(const Variation& variation) {
  return variation.key + '=' + value_text(variation, variation.low) + ':' + value_text(variation, variation.high) +
         (variation.by_factors ? ":log" : "");
}

std::vector<std::vector<std::string>> value_texts(const std::vector<Variation>& variations,
                                                  const std::vector<std::vector<double>>& values) {
  std::vector<std::vector<std::string>> texts;
  for (const auto& sample : values) {
    texts.emplace_back();
    for (std::size_t v = 0; v < variations.size(); ++v) texts.back().push_back(value_text(variations[v], sample[v]));
  }
  return texts;
}

std::vector<std::vector<std::string>> ends_of(const std::vector<Variation>& variations) {
  std::vector<std::vector<double>> ends(2);
  for (const Variation& variation : variations) {
    ends[0].push_back(variation.low);
    ends[1].push_back(variation.high);
  }
  return value_texts(variations, ends);
}

Band band_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  return {percentile(values, 5), percentile(values, 50), percentile(values, 95)};
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::isfinite(a[i]) && std::isfinite(b[i])) x.push_back(a[i]), y.push_back(b[i]);
  if (x.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  const Moments sums = moments_of(ranks_of(x), ranks_of(y));
  return sums.xx > 0 && sums.yy > 0 ? sums.xy / std::sqrt(sums.xx * sums.yy) : 0;
}

}  // namespace geodrop
