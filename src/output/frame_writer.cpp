#include "frame_writer.hpp"

#include <utility>

namespace geodrop {
namespace {

constexpr std::size_t queue_limit = 2;

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
  changed_.wait(lock, [&] { return queue_.size() < queue_limit || failure_; });
  throw_if_failed();
  snapshot.index = times_.size();
  times_.push_back(snapshot.t);
  queue_.push_back(std::move(snapshot));
  changed_.notify_all();
}

void FrameWriter::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return queue_.empty() || failure_; });
  throw_if_failed();
}

void FrameWriter::throw_if_failed() {
  if (failure_) std::rethrow_exception(failure_);
}

void FrameWriter::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return !queue_.empty() || closing_; });
    if (queue_.empty() || failure_) return;
    const Snapshot& snapshot = queue_.front();  // a deque keeps it in place while others are queued
    lock.unlock();
    std::exception_ptr failure;
    try {
      write(snapshot);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    failure_ = failure;
    queue_.pop_front();
    changed_.notify_all();
    if (failure_) return;
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
  written_times_.push_back(snapshot.t);
  write_collection(directory_, "particles", "vtu", written_times_);
  if (has_membranes) write_collection(directory_, "membranes", "vtp", written_times_);
  if (snapshot.has_rigid) write_collection(directory_, "rigid", "vtp", written_times_);
}

}  // namespace geodrop
