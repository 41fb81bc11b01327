#include "ensemble.hpp"

#include "base/text.hpp"
#include "batch.hpp"

namespace geodrop {
namespace {

/// What the values of the runs follow from, one per line.
std::string design(const EnsembleOptions& options) {
  std::string text = "samples " + std::to_string(options.samples) + "\nseed " + std::to_string(options.seed) + '\n';
  for (const Variation& variation : options.variations) text += "vary " + variation_text(variation) + '\n';
  return text;
}

void write_bands(const EnsembleOptions& options, const Batch& batch) {
  std::vector<std::vector<std::string>> lines{{"result", "5 %", "median", "95 %"}};
  for (std::size_t r = 0; r < batch.result_names().size(); ++r) {
    const Band band = band_of(batch.column(r));
    lines.push_back({batch.result_names()[r], format_number(band.low, 4), format_number(band.median, 4),
                     format_number(band.high, 4)});
  }
  publish(options.output / "bands.csv", lines);
}

void write_correlations(const EnsembleOptions& options, const std::vector<std::vector<double>>& values,
                        const Batch& batch) {
  std::vector<std::vector<std::string>> lines{{"rank correlation of"}};
  for (const Variation& variation : options.variations) lines.front().push_back(variation.key);
  for (std::size_t r = 0; r < batch.result_names().size(); ++r) {
    lines.push_back({batch.result_names()[r]});
    for (std::size_t v = 0; v < options.variations.size(); ++v) {
      std::vector<double> inputs;
      for (const auto& sample : values) inputs.push_back(sample[v]);
      lines.back().push_back(format_number(rank_correlation(inputs, batch.column(r)), 2));
    }
  }
  publish(options.output / "correlations.csv", lines);
}

}  // namespace

int run_ensemble(const EnsembleOptions& options) {
  const auto values = latin_hypercube(options.variations, options.samples, options.seed);
  BatchOptions of{options.scene, options.overrides, {},    options.output,
                  options.jobs,  "an ensemble",     "run", design(options)};
  for (const Variation& variation : options.variations) of.keys.push_back(variation.key);
  Batch batch(std::move(of), value_texts(options.variations, values));
  batch.check(ends_of(options.variations));
  batch.claim();
  const int code = batch.run();
  write_bands(options, batch);
  write_correlations(options, values, batch);
  return code;
}

}  // namespace geodrop
