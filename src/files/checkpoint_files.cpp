#include "checkpoint_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <geodrop/base/error.hpp>

#include "base/atomic_file.hpp"
#include "state/archive.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;

constexpr const char* next_checkpoint = "checkpoint.next.bin";
constexpr const char* room_name = "checkpoint.reserve";

/// Adds up what an archive of a state takes.
class Counter {
 public:
  template <class T>
  void bytes(const T*, std::size_t count) {
    total_ += count * sizeof(T);
  }
  std::size_t length(std::size_t present, std::size_t = 0) {
    total_ += sizeof(present);
    return present;
  }
  std::size_t total() const { return total_; }

 private:
  std::size_t total_ = 0;
};

template <int Dim>
std::size_t checkpoint_bytes(const State<Dim>& state, const OutputRecord& record) {
  constexpr std::size_t header = 4096;  // and more
  Counter counter;
  walk(counter, state);
  std::size_t numbers = record.frame_times.size();
  for (const std::vector<double>& row : record.rows) numbers += row.size() + 1;
  return header + counter.total() + numbers * sizeof(double);
}

/// One that goes on; if it does not, what is wrong with it joins `refused`.
template <int Dim>
std::optional<Checkpoint<Dim>> read_good(const fs::path& path, const Scene& scene, const FaultOf<Dim>& fault_of,
                                         std::vector<SceneProblem>& refused) {
  std::optional<Checkpoint<Dim>> found;
  try {
    found = read_checkpoint<Dim>(path, scene);
  } catch (const SceneError& error) {
    refused.push_back(error.problems().front());
    return std::nullopt;
  }
  const std::string fault = fault_of ? fault_of(found->state) : "";
  if (fault.empty()) return found;
  refused.push_back({{}, "--resume", "a checkpoint with " + fault, "a state of this scene", ProblemSource::elsewhere});
  return std::nullopt;
}

std::string warning_of(const std::vector<SceneProblem>& refused) {
  if (refused.empty()) return "";
  return std::string("warning: ") + newest_checkpoint + " is no use: " + refused.front().found +
         "; the run goes on from the one before, " + previous_checkpoint;
}

void remove_quietly(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

}  // namespace

template <int Dim>
FoundCheckpoint<Dim> find_checkpoint(const fs::path& directory, const Scene& scene, const FaultOf<Dim>& fault_of) {
  std::vector<SceneProblem> refused;
  std::optional<Checkpoint<Dim>> found = read_good<Dim>(directory / newest_checkpoint, scene, fault_of, refused);
  if (found) return {std::move(*found), newest_checkpoint, ""};
  if (!fs::exists(directory / previous_checkpoint)) throw SceneError(directory / newest_checkpoint, refused);
  found = read_good<Dim>(directory / previous_checkpoint, scene, fault_of, refused);
  if (found) return {std::move(*found), previous_checkpoint, warning_of(refused)};
  refused.front().key = newest_checkpoint + (": " + refused.front().key);
  refused.back().key = previous_checkpoint + (": " + refused.back().key);
  throw SceneError(directory, refused);
}

CheckpointFiles::~CheckpointFiles() { give_room_back(); }

void CheckpointFiles::begin_with(const std::string& name, double t) {
  if (name != newest_checkpoint) fs::rename(directory_ / name, directory_ / newest_checkpoint);
  newest_time_ = t;
}

template <int Dim>
void CheckpointFiles::write(const Scene& scene, const State<Dim>& state, const OutputRecord& record) {
  const fs::path next = directory_ / next_checkpoint, newest = directory_ / newest_checkpoint;
  try {
    write_checkpoint(next, scene, state, record);
  } catch (const WriteError&) {
    if (room_ == 0) throw;
    give_room_back();
    write_checkpoint(next, scene, state, record);
  }
  std::error_code error;
  if (fs::exists(newest)) fs::rename(newest, directory_ / previous_checkpoint, error);
  if (!error) fs::rename(next, newest, error);
  if (error) throw_not_written(newest, error.value());
  sync_directory(directory_);
  newest_time_ = state.t;
}

template <int Dim>
void CheckpointFiles::keep_room(const State<Dim>& state, const OutputRecord& record, std::size_t more) {
  const std::size_t needed = checkpoint_bytes(state, record) + more;
  if (needed > room_) keep_room(needed + needed / 4);  // a checkpoint grows by every row of the history
}

void CheckpointFiles::keep_room(std::size_t bytes) {
  constexpr int owner_only = 0600;
  const fs::path path = directory_ / room_name;
  if (room_ == 0) remove_quietly(path);  // a killed run's, or a link
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, owner_only);
  if (file < 0) throw_not_written(path, errno);
  const int error = posix_fallocate(file, 0, static_cast<off_t>(bytes));
  close(file);
  // Only a disk that is full can be mended; where nothing can be kept free, nothing is.
  if (error == 0) room_ = bytes;
  if (error == ENOSPC || error == EDQUOT) {
    give_room_back();
    throw_not_written(directory_ / newest_checkpoint, error);
  }
}

void CheckpointFiles::give_room_back() {
  room_ = 0;
  remove_quietly(directory_ / room_name);
}

void CheckpointFiles::keep_newest_only() {
  remove_quietly(directory_ / previous_checkpoint);
  give_room_back();
}

template FoundCheckpoint<2> find_checkpoint(const fs::path&, const Scene&, const FaultOf<2>&);
template FoundCheckpoint<3> find_checkpoint(const fs::path&, const Scene&, const FaultOf<3>&);
template void CheckpointFiles::write(const Scene&, const State<2>&, const OutputRecord&);
template void CheckpointFiles::write(const Scene&, const State<3>&, const OutputRecord&);
template void CheckpointFiles::keep_room(const State<2>&, const OutputRecord&, std::size_t);
template void CheckpointFiles::keep_room(const State<3>&, const OutputRecord&, std::size_t);

}  // namespace geodrop
