// Writes frames in a thread of its own, so that the step loop only waits if the disk falls behind by two frames.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>
#include <vector>

#include "snapshot.hpp"
#include "vtk_files.hpp"

namespace geodrop {

class FrameWriter {
 public:
  /// `times`: of the frames that the directory has already (a resumed run).
  FrameWriter(std::filesystem::path directory, Compression compression, std::vector<double> times);
  /// Writes what is queued.
  ~FrameWriter();

  /// Queues a frame and gives it the next index; waits while two are queued. Throws RunError if an earlier frame could
  /// not be written.
  void submit(Snapshot snapshot);
  /// Waits until everything queued is on disk. Throws likewise.
  void wait();
  /// Of all frames submitted so far.
  const std::vector<double>& times() const { return times_; }

 private:
  void run();
  void write(const Snapshot& snapshot);
  void throw_if_failed();

  std::filesystem::path directory_;
  Compression compression_;
  std::vector<double> times_;          ///< of the loop's thread
  std::vector<double> written_times_;  ///< of the writer's thread

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Snapshot> queue_;  ///< the first one is being written
  std::exception_ptr failure_;
  bool closing_ = false;
  std::thread thread_;  // last: starts when all above is there
};

}  // namespace geodrop
