// `bench --instructions`: instructions of a particle-step, counted by valgrind's callgrind, beside the committed ones.
// Unlike seconds they do not depend on what else the machine does: repeats agree to 0.01 %.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace geodrop {

/// A row of perf/instructions.csv. Counts compare only for the same build, number of particles and number of steps.
struct InstructionCount {
  std::string name, build;  ///< benchmark; compiler and instruction set of the kernels
  std::size_t particles = 0;
  int steps = 0;
  double per_particle_step = 0;

  bool same_work(const InstructionCount& other) const {
    return name == other.name && build == other.build && particles == other.particles && steps == other.steps;
  }
};

/// Share of instructions more than the committed ones that fails (perf/README.md).
inline constexpr double allowed_more = 0.02;

struct InstructionVerdict {
  InstructionCount counted;
  std::optional<double> committed;  ///< instructions of a particle-step; none: there is no such row

  double change() const { return counted.per_particle_step / *committed - 1; }
  bool more() const { return committed && !(change() <= allowed_more); }
  bool fewer() const { return committed && change() < -allowed_more; }
};

std::vector<InstructionVerdict> compare_instructions(const std::vector<InstructionCount>& counted,
                                                     const std::vector<InstructionCount>& committed);

/// The committed rows with those of the same name and build replaced, and new ones behind.
std::vector<InstructionCount> merge_instructions(std::vector<InstructionCount> committed,
                                                 const std::vector<InstructionCount>& counted);

/// No file: no rows. Throws SceneError that names file and line of what is no row.
std::vector<InstructionCount> read_instructions(const std::filesystem::path& file);
void write_instructions(const std::filesystem::path& file, const std::vector<InstructionCount>& rows);

/// Instructions in a dump of callgrind but those of the memory allocator (glibc, malloc.c): how long it looks for room
/// hangs on the length of the paths that the program was given. Throws std::runtime_error if the dump has no counts.
double instructions_in(const std::string& dump);

}  // namespace geodrop
