// Keeps two runs out of one directory.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace geodrop {

/// Name of this machine.
std::string host_name();

/// Who holds the lock of a directory, e.g. "process 4711 on host weir"; none if no run is at work there.
std::optional<std::string> run_at_work(const std::filesystem::path& directory);

/// A lock on run.lock in a directory, which names process and machine. The system drops it when the process ends,
/// however it ends. It goes with its directory if that is renamed.
class RunLock {
 public:
  static constexpr const char* file_name = "run.lock";

  /// Throws SceneError, which names process and machine, if another run is at work there; WriteError if the file cannot
  /// be made. Where the file system knows no locks there is none.
  explicit RunLock(const std::filesystem::path& directory);
  /// Takes the file away.
  ~RunLock();
  RunLock(RunLock&& other) noexcept;
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  bool try_to_take(const std::filesystem::path& directory);
  void close_both();

  int directory_ = -1, file_ = -1;
};

}  // namespace geodrop
