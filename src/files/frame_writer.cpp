#include "frame_writer.hpp"

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <exception>
#include <utility>

namespace geodrop {
namespace {

constexpr std::size_t queue_limit = 2;

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

std::size_t bytes_of(const std::vector<Field>& fields) {
  std::size_t bytes = 0;
  for (const Field& field : fields) bytes += bytes_of(field.values);
  return bytes;
}

/// Upper bound of what the files of a frame take, uncompressed [byte].
std::size_t bytes_on_disk(const Snapshot& of) {
  constexpr std::size_t cell = 12;         // connectivity, offset, type
  constexpr std::size_t rest = 32 * 1024;  // all that is no number, and whole blocks of the disk
  const std::size_t cells = of.particles.id.size() + of.membranes.membrane.size() + of.rigid.rigid.size();
  const std::size_t bytes = cells * cell + bytes_of(of.particles.points) + bytes_of(of.particles.fields) +
                            bytes_of(of.particles.layer) + bytes_of(of.particles.material) +
                            bytes_of(of.particles.body) + bytes_of(of.particles.id) + bytes_of(of.membranes.points) +
                            bytes_of(of.membranes.fields) + bytes_of(of.membranes.membrane) +
                            bytes_of(of.rigid.points) + bytes_of(of.rigid.fields) + bytes_of(of.rigid.rigid);
  return 4 * bytes / 3 + rest;  // four letters for three bytes
}

/// Of this thread, after the threads that compute: each of these waits for the others at every loop.
void work_behind_others() {
#ifdef __linux__
  constexpr int niceness = 10;
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), niceness);
#endif
}

}  // namespace

FrameWriter::FrameWriter(std::filesystem::path directory, Compression compression, std::vector<double> times)
    : directory_(std::move(directory)),
      compression_(compression),
      times_(times),
      written_times_(std::move(times)),
      thread_([this] { run(); }) {}

FrameWriter::~FrameWriter() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void FrameWriter::submit(Snapshot snapshot) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return queue_.size() < queue_limit || paused_; });
  frame_bytes_ = std::max(frame_bytes_, bytes_on_disk(snapshot));
  snapshot.index = times_.size();
  times_.push_back(snapshot.t);
  queue_.push_back(std::move(snapshot));
  changed_.notify_all();
}

void FrameWriter::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return queue_.empty() || paused_; });
}

std::string FrameWriter::failure() {
  const std::lock_guard lock(mutex_);
  return failure_;
}

std::size_t FrameWriter::try_again() {
  std::unique_lock lock(mutex_);
  paused_ = false;
  changed_.notify_all();
  changed_.wait(lock, [&] { return queue_.empty() || paused_; });
  return queue_.size();
}

void FrameWriter::run() {
  work_behind_others();
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return (!queue_.empty() && !paused_) || closing_; });
    if (queue_.empty() || paused_) return;
    const Snapshot& snapshot = queue_.front();  // a deque keeps it in place while others are queued
    lock.unlock();
    std::string failure;
    try {
      write(snapshot);
    } catch (const std::exception& error) {
      failure = error.what();
    }
    lock.lock();
    paused_ = !failure.empty();
    if (paused_) {
      if (failure_.empty()) failure_ = failure;
      failed_ = true;
    } else {
      queue_.pop_front();
    }
    changed_.notify_all();
  }
}

void FrameWriter::write(const Snapshot& snapshot) {
  const auto path = [&](const char* kind, const char* extension) {
    return directory_ / frame_file_name(kind, snapshot.index, extension);
  };
  write_particles(path("particles", "vtu"), snapshot.particles, snapshot.t, compression_);
  const bool has_membranes = !snapshot.membranes.points.empty();
  if (has_membranes) write_membranes(path("membranes", "vtp"), snapshot.membranes, snapshot.t, compression_);
  if (snapshot.has_rigid) write_rigid(path("rigid", "vtp"), snapshot.rigid, snapshot.t, compression_);
  written_times_.resize(snapshot.index);  // a second try begins anew
  written_times_.push_back(snapshot.t);
  write_collection(directory_, "particles", "vtu", written_times_);
  if (has_membranes) write_collection(directory_, "membranes", "vtp", written_times_);
  if (snapshot.has_rigid) write_collection(directory_, "rigid", "vtp", written_times_);
}

}  // namespace geodrop
