// Writes frames in a thread of its own, so that the step loop only waits if the disk falls behind by two frames.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <mutex>
#include <string>
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

  /// Queues a frame and gives it the next index; waits while two are queued. After a failure frames stay in the queue.
  void submit(Snapshot snapshot);
  /// Waits until everything queued is on disk, or cannot be written.
  void wait();
  /// Whether a frame could not be written; cheap.
  bool failed() const { return failed_; }
  /// Why, the first time; empty if none failed.
  std::string failure();
  /// Tries what is queued once more, and waits. Returns how many frames are still not written.
  std::size_t try_again();
  /// Of all frames submitted so far.
  const std::vector<double>& times() const { return times_; }
  /// Bound of the bytes that a frame takes on disk, of the largest so far.
  std::size_t frame_bytes() const { return frame_bytes_; }

 private:
  void run();
  void write(const Snapshot& snapshot);

  std::filesystem::path directory_;
  Compression compression_;
  std::vector<double> times_;          ///< of the loop's thread
  std::vector<double> written_times_;  ///< of the writer's thread
  std::size_t frame_bytes_ = 0;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Snapshot> queue_;  ///< the first one is being written
  bool paused_ = false;         ///< the first one could not be written
  std::string failure_;
  std::atomic<bool> failed_ = false;
  bool closing_ = false;
  std::thread thread_;  // last: starts when all above is there
};

}  // namespace geodrop
