// Has a benchmark lost speed? Judged by its ratio to the reference kernels of the same run, never by seconds.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace geodrop {

/// A committed ratio and what it was measured with.
struct CommittedRatio {
  std::string name, processor;
  std::size_t particles = 0;
  int threads = 1;
  double ratio = 0;  ///< time that the reference kernels need for the same work, over the time taken [-]
};

/// Allowed loss. Another processor has its own balance of arithmetic and memory, so there only a gross loss shows.
inline constexpr double allowed_loss = 0.1;
inline constexpr double allowed_loss_elsewhere = 0.5;
/// Measurements before a loss is believed: another process may have taken a core.
inline constexpr int most_tries = 3;

/// Outcome of one comparison.
struct RatioVerdict {
  double best = 0;  ///< ratio of the best try [-]
  int tries = 0;
  bool lost = false;
};
/// Calls `measure` until a ratio reaches (1 - loss) of the committed one, three times at most.
RatioVerdict judge_ratio(double committed, double loss, const std::function<double()>& measure);

/// Reads a table with the columns name, processor, particles, threads, ratio among others; throws SceneError
/// that names the file, and the column that it misses or the line that is wrong.
std::vector<CommittedRatio> read_ratios(const std::filesystem::path& file);

/// The committed ratio of this name, number of particles and threads, or nullptr.
const CommittedRatio* find_ratio(const std::vector<CommittedRatio>& ratios, const CommittedRatio& like);

/// Of several files of ratios that of this processor, or else the first, or an empty path.
std::filesystem::path choose_ratios(std::vector<std::filesystem::path> files, const std::string& processor);

}  // namespace geodrop
