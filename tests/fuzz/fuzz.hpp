// What the fuzzers share: how many inputs, chance with a seed, the input on disk while it is tried, a limit of time.
//
// Each fuzzer makes the same inputs at every run: the seed of input i is i. In CI a fixed number of them, by hand more:
//
//     GEODROP_FUZZ_INPUTS=100000 build/release/geodrop_tests --source-file='*tests/fuzz/scene.cpp'
//     GEODROP_FUZZ_FIRST=4711 GEODROP_FUZZ_INPUTS=1 ...      that one alone
//
// The input that is tried stands in GEODROP_FUZZ_KEEP (default: geodrop_fuzz in the directory for temporary files),
// with the number of its seed in its name; what failed, crashed or took longer than its share of time is left there.
#pragma once

#include <doctest/doctest.h>

#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace geodrop::fuzz {

/// Chance that is the same on every platform.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : generator_(seed) {}
  std::uint64_t number() { return generator_(); }
  /// From 0 to n - 1.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(generator_() % n); }
  bool one_in(std::size_t n) { return below(n) == 0; }
  template <class List>
  auto& of(List& list) {
    return list[below(std::size(list))];
  }

 private:
  std::mt19937_64 generator_;
};

inline std::uint64_t setting(const char* name, std::uint64_t standard) {
  const char* value = std::getenv(name);
  return value ? std::strtoull(value, nullptr, 10) : standard;
}

/// Numbers that programs stumble over.
inline const std::vector<std::string>& odd_numbers() {
  static const std::vector<std::string> all{
      "0",      "-0.0",  "1",    "-1",    "0.5",     "1e-3",   "1e3",        "1e-9",       "1e9",
      "1e-300", "1e300", "inf",  "-inf",  "nan",     "2",      "3",          "7",          "255",
      "256",    "65536", "1e15", "1e-15", "1.7e308", "5e-324", "2147483647", "2147483648", "9223372036854775807",
      "-1e300", "1e7",   "1e-6", "0.1",   "-1e-3",   "90",     "89.9999999", "0.49999999", "0.9999999999999999"};
  return all;
}

/// A longer time than this without an end is a hang [s of processor time]. Sanitizers slow a run down five to ten
/// times.
#ifdef __SANITIZE_ADDRESS__
inline constexpr int patience = 40, share_in_ci = 10;
#else
inline constexpr int patience = 5, share_in_ci = 1;
#endif

/// Ends the program, which leaves the input on disk: nothing else can be done about a loop.
inline void on_hang(int) {
  constexpr char text[] = "fuzz: an input took too long; it is kept\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, sizeof text - 1);
  _exit(3);
}

inline void limit_time(int seconds) {
  signal(SIGPROF, on_hang);
  const itimerval limit{{0, 0}, {seconds, 0}};
  setitimer(ITIMER_PROF, &limit, nullptr);
}

/// The directory of inputs of one fuzzer, and how they fared.
class Trials {
 public:
  Trials(std::string what, std::uint64_t in_ci)
      : what_(std::move(what)),
        first_(setting("GEODROP_FUZZ_FIRST", 0)),
        count_(setting("GEODROP_FUZZ_INPUTS", in_ci / share_in_ci)),
        directory_(keep()) {
    std::filesystem::create_directories(directory_);
  }
  ~Trials() {
    limit_time(0);
    std::printf("fuzz %s: %llu inputs", what_.c_str(), static_cast<unsigned long long>(count_));
    for (const auto& [name, number] : counts_) std::printf(", %llu %s", number, name.c_str());
    std::printf("; slowest %.2f s, seed %llu\n", slowest_, static_cast<unsigned long long>(slowest_seed_));
  }
  Trials(const Trials&) = delete;
  Trials& operator=(const Trials&) = delete;

  /// `make(chance)` gives the text of an input; `attempt(path, chance)` returns what became of it, in a word or two, or
  /// "failed: ...".
  template <class Make, class Attempt>
  void run(const std::string& ending, Make make, Attempt attempt) {
    for (std::uint64_t seed = first_; seed < first_ + count_; ++seed) {
      Chance chance(seed);
      const std::filesystem::path path = directory_ / (what_ + "_" + std::to_string(seed) + ending);
      std::ofstream(path, std::ios::binary) << make(chance);
      const auto start = std::chrono::steady_clock::now();
      limit_time(patience);
      std::string became;
      try {
        became = attempt(path, chance);
      } catch (const std::exception& error) {
        became = std::string("failed: internal error: ") + error.what();
      }
      limit_time(0);
      note(seed, became, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      if (!became.starts_with("failed")) std::filesystem::remove(path);
    }
  }

 private:
  std::filesystem::path keep() const {
    const char* asked = std::getenv("GEODROP_FUZZ_KEEP");
    return asked ? std::filesystem::path(asked) : std::filesystem::temp_directory_path() / "geodrop_fuzz";
  }
  void note(std::uint64_t seed, const std::string& became, double seconds) {
    if (became.starts_with("failed"))
      FAIL_CHECK(what_ << " seed " << seed << " " << became << "; the input is kept in " << directory_.string());
    ++counts_[became.starts_with("failed") ? "failed" : became];
    if (seconds <= slowest_) return;
    slowest_ = seconds;
    slowest_seed_ = seed;
  }

  std::string what_;
  std::uint64_t first_, count_;
  std::filesystem::path directory_;
  std::map<std::string, unsigned long long> counts_;
  double slowest_ = 0;
  std::uint64_t slowest_seed_ = 0;
};

}  // namespace geodrop::fuzz
