// The checkpoints of a run directory: the last two, and room on the disk for one more.
#pragma once

#include <geodrop/files/checkpoint.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace geodrop {

constexpr const char* newest_checkpoint = "checkpoint.bin";
constexpr const char* previous_checkpoint = "checkpoint.previous.bin";

/// A checkpoint as found, and what to tell of it.
template <int Dim>
struct FoundCheckpoint {
  Checkpoint<Dim> checkpoint;
  std::string name;     ///< of its file
  std::string warning;  ///< why it is not the newest; empty if it is
};

/// The newest good one of a directory: it can be read, and `fault_of` (none: nothing) finds no fault in its state. If
/// there is none, throws SceneError that says of each file what is wrong with it.
template <int Dim>
FoundCheckpoint<Dim> find_checkpoint(const std::filesystem::path& directory, const Scene& scene,
                                     const FaultOf<Dim>& fault_of = {});

/// Writes checkpoints. The disk may fill up beside a run, so the room for one more is taken beforehand, with that for
/// the pictures that wait to be written, and is given back when a file does not fit any more.
class CheckpointFiles {
 public:
  explicit CheckpointFiles(std::filesystem::path directory) : directory_(std::move(directory)) {}
  /// Gives the room back.
  ~CheckpointFiles();
  CheckpointFiles(const CheckpointFiles&) = delete;
  CheckpointFiles& operator=(const CheckpointFiles&) = delete;

  /// Puts a checkpoint of this name, and no other, into the place of the newest.
  void begin_with(const std::string& name, double t);
  /// Adds the newest; the one before becomes the previous one, and that one goes. Throws WriteError if there is no room
  /// even with what was kept free.
  template <int Dim>
  void write(const Scene& scene, const State<Dim>& state, const OutputRecord& record);
  /// Keeps room for the next checkpoint and `more` bytes. Throws WriteError if there is none.
  template <int Dim>
  void keep_room(const State<Dim>& state, const OutputRecord& record, std::size_t more);
  void give_room_back();
  /// A run that is finished needs only the last one.
  void keep_newest_only();
  /// Time of the newest one [s]; empty if there is none.
  std::optional<double> newest_time() const { return newest_time_; }

 private:
  void keep_room(std::size_t bytes);

  std::filesystem::path directory_;
  std::size_t room_ = 0;  ///< kept free [byte]
  std::optional<double> newest_time_;
};

}  // namespace geodrop
