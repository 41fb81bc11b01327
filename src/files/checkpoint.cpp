// The file: magic, format version, dimension, build, what of the scene lasts, state, output record, checksum of all
// before it.
//
// The checksum tells accidents. What passes it may still be of a buggy or hostile writer, so every length is compared
// with the bytes that are left, and every short read is refused.
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <geodrop/base/error.hpp>
#include <geodrop/base/input_file.hpp>
#include <geodrop/files/checkpoint.hpp>
#include <memory>
#include <utility>

#include "base/atomic_file.hpp"
#include "base/lasting_text.hpp"
#include "base/text.hpp"
#include "build_identity.hpp"
#include "state/archive.hpp"

namespace geodrop {
namespace {

constexpr std::array<char, 8> magic = {'g', 'e', 'o', 'd', 'r', 'o', 'p', 'C'};
/// To be raised when the layout of the file changes, i.e. with every change to archive.hpp.
constexpr std::uint32_t format_version = 13;

class Hash {
 public:
  static constexpr bool passes_over_empty = true;
  Hash() : state_(XXH3_createState()) { XXH3_64bits_reset(state_.get()); }
  template <class T>
  void bytes(const T* first, std::size_t count) {
    if (count > 0) XXH3_64bits_update(state_.get(), first, count * sizeof(T));
  }
  std::size_t length(std::size_t present, std::size_t) {
    bytes(&present, 1);
    return present;
  }
  std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

 private:
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state_;
};

class Writer {
 public:
  explicit Writer(AtomicFile& file) : file_(file) {}
  template <class T>
  void bytes(const T* first, std::size_t count) {
    file_.write(first, count * sizeof(T));
    hash_.bytes(first, count);
  }
  std::size_t length(std::size_t present, std::size_t) {
    bytes(&present, 1);
    return present;
  }
  std::uint64_t checksum() const { return hash_.digest(); }

 private:
  AtomicFile& file_;
  Hash hash_;
};

/// Why the content of a file is no checkpoint of this format.
struct Damage {
  std::string found;
};

class Reader {
 public:
  /// The next `bytes` of a file.
  Reader(std::FILE* file, std::uint64_t bytes) : file_(file), left_(bytes) {}
  template <class T>
  void bytes(T* first, std::size_t count) {
    if (count > left_ / sizeof(T)) refuse("a list that is longer than the file");
    if (std::fread(static_cast<void*>(first), sizeof(T), count, file_) != count)
      refuse("a file that ends early or cannot be read");
    left_ -= count * sizeof(T);
  }
  void bytes(bool* first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      std::uint8_t value = 0;
      bytes(&value, 1);
      if (value > 1) refuse("a yes or no of value " + std::to_string(value));
      first[i] = value == 1;
    }
  }
  std::size_t length(std::size_t, std::size_t bytes_each) {
    std::uint64_t stored = 0;
    bytes(&stored, 1);
    if (stored > left_ / bytes_each) refuse("a list of " + std::to_string(stored) + ", longer than the file");
    return stored;
  }
  std::uint64_t left() const { return left_; }
  [[noreturn]] void refuse(const std::string& found) const { throw Damage{found}; }

 private:
  std::FILE* file_;
  std::uint64_t left_;
};

template <class Archive, class Record>
void walk_record(Archive& archive, Record& record) {
  walk(archive, record.frame_times);
  walk(archive, record.rows);
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& found, const std::string& allowed) {
  throw SceneError(path.string(), {{{}, "--resume", found, allowed, ProblemSource::elsewhere}});
}

/// Hash of the next `length` bytes of a file.
std::uint64_t hash_file(Reader& reader, std::uint64_t length) {
  Hash hash;
  std::vector<char> block(std::size_t{1} << 20);
  while (length > 0) {
    const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(length, block.size()));
    reader.bytes(block.data(), count);
    hash.bytes(block.data(), count);
    length -= count;
  }
  return hash.digest();
}

/// What stands before the state. The first two members are at the same place in all formats.
struct Header {
  std::array<char, 8> magic{};
  std::uint32_t version = 0, dimension = 0;
  BuildIdentity build;
  std::string scene;  ///< lasting_text
};

template <class Archive, class H>
void walk_kind(Archive& archive, H& header) {
  archive.bytes(header.magic.data(), header.magic.size());
  archive.bytes(&header.version, 1);
}
template <class Archive, class H>
void walk_rest(Archive& archive, H& header) {
  archive.bytes(&header.dimension, 1);
  walk(archive, header.build.version);
  walk(archive, header.build.compiler);
  walk(archive, header.build.sums);
  walk(archive, header.scene);
}

constexpr std::uint64_t checksum_bytes = sizeof(std::uint64_t);

/// The order of checks gives the reason that helps most.
void check_file(const InputFile& input, const std::filesystem::path& path) {
  if (!input.file) refuse(path, input.fault, "the directory of a run that was stopped with a checkpoint");
  Header header;
  const std::string whole = "a whole checkpoint";
  try {
    Reader reader(input.file.get(), input.size);
    walk_kind(reader, header);
  } catch (const Damage&) {
    header.magic = {};
  }
  if (header.magic != magic) refuse(path, "not a checkpoint", "a checkpoint.bin written by geodrop");
  if (header.version != format_version)
    refuse(path, "checkpoint format " + std::to_string(header.version),
           "format " + std::to_string(format_version) + ": resume with the geodrop that wrote it");
  std::uint64_t stored = 0, computed = 1;
  try {
    std::rewind(input.file.get());
    Reader reader(input.file.get(), input.size);
    computed = hash_file(reader, input.size - checksum_bytes);
    reader.bytes(&stored, 1);
  } catch (const Damage& damage) {
    refuse(path, damage.found, whole);
  }
  if (stored != computed) refuse(path, "a truncated or damaged checkpoint (checksum differs)", whole);
  std::rewind(input.file.get());
}

/// What it is a checkpoint of.
void check_header(const Header& header, const std::filesystem::path& path, const Scene& scene,
                  std::uint32_t dimension) {
  const std::string same =
      "the scene, with the same --set, that the run was started with (time.end, title, output, "
      "results, expect, verify and variants may differ)";
  const std::string lasting = lasting_text(scene.as_run);
  if (header.scene != lasting)
    refuse(path, "a checkpoint of another scene: " + first_difference(header.scene, lasting), same);
  if (header.dimension != dimension) refuse(path, "a checkpoint of another scene: another dimension", same);
}

/// A resumed run goes on with these lists.
void check_record(const OutputRecord& record, double t, std::size_t columns) {
  for (const std::vector<double>& row : record.rows)
    if (row.size() != columns || !(row.front() <= t))
      throw Damage{"a row of the history that this scene does not write"};
  for (std::size_t i = 0; i < record.frame_times.size(); ++i)
    if (!(record.frame_times[i] <= t) || (i > 0 && !(record.frame_times[i] > record.frame_times[i - 1])))
      throw Damage{"frames that are out of order"};
}

std::string warning_of(const BuildIdentity& build) {
  const std::string different = differences(build, this_build());
  return different.empty() ? ""
                           : "warning: the checkpoint was written by another build or on another processor (" +
                                 different + "): the last bits of what follows may differ from an uninterrupted run";
}

}  // namespace

template <int Dim>
std::string state_hash(const State<Dim>& state) {
  Hash hash;
  walk(hash, state);
  return format_hash(hash.digest());
}

template <int Dim>
void write_checkpoint(const std::filesystem::path& path, const Scene& scene, const State<Dim>& state,
                      const OutputRecord& output) {
  AtomicFile file(path);
  Writer writer(file);
  const Header header{magic, format_version, Dim, this_build(), lasting_text(scene.as_run)};
  walk_kind(writer, header);
  walk_rest(writer, header);
  walk(writer, state);
  walk_record(writer, output);
  const std::uint64_t checksum = writer.checksum();
  writer.bytes(&checksum, 1);
  file.commit();
}

template <int Dim>
Checkpoint<Dim> read_checkpoint(const std::filesystem::path& path, const Scene& scene) {
  const InputFile input = open_input(path);
  check_file(input, path);
  try {
    Reader reader(input.file.get(), input.size - checksum_bytes);
    Header header;
    walk_kind(reader, header);
    walk_rest(reader, header);
    check_header(header, path, scene, Dim);
    Checkpoint<Dim> checkpoint;
    walk(reader, checkpoint.state);
    walk_record(reader, checkpoint.output);
    if (reader.left() > 0) reader.refuse(std::to_string(reader.left()) + " bytes more than a checkpoint has");
    check_record(checkpoint.output, checkpoint.state.t, history_columns(scene).size());
    checkpoint.warning = warning_of(header.build);
    return checkpoint;
  } catch (const Damage& damage) {
    refuse(path, "a damaged checkpoint: " + damage.found, "a checkpoint.bin written by geodrop");
  }
}

template std::string state_hash(const State<2>&);
template std::string state_hash(const State<3>&);
template void write_checkpoint(const std::filesystem::path&, const Scene&, const State<2>&, const OutputRecord&);
template void write_checkpoint(const std::filesystem::path&, const Scene&, const State<3>&, const OutputRecord&);
template Checkpoint<2> read_checkpoint(const std::filesystem::path&, const Scene&);
template Checkpoint<3> read_checkpoint(const std::filesystem::path&, const Scene&);

}  // namespace geodrop
