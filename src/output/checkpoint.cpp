// The file: magic, format version, dimension, scene hash, state, output record, checksum of all before it.
#include <xxhash.h>

#include <cstring>
#include <fstream>
#include <geodrop/checkpoint.hpp>
#include <geodrop/error.hpp>
#include <memory>
#include <utility>

#include "archive.hpp"
#include "atomic_file.hpp"

namespace geodrop {
namespace {

constexpr std::array<char, 8> magic = {'g', 'e', 'o', 'd', 'r', 'o', 'p', 'C'};
/// To be raised when the layout of the file changes, i.e. with every change to archive.hpp.
constexpr std::uint32_t format_version = 9;

class Hash {
 public:
  Hash() : state_(XXH3_createState()) { XXH3_64bits_reset(state_.get()); }
  template <class T>
  void bytes(const T* first, std::size_t count) {
    if (count > 0) XXH3_64bits_update(state_.get(), first, count * sizeof(T));
  }
  std::size_t length(std::size_t present) {
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
  std::size_t length(std::size_t present) {
    bytes(&present, 1);
    return present;
  }
  std::uint64_t checksum() const { return hash_.digest(); }

 private:
  AtomicFile& file_;
  Hash hash_;
};

/// Reads a file whose checksum is known to be right, so it cannot end early.
class Reader {
 public:
  explicit Reader(std::ifstream& file) : file_(file) {}
  template <class T>
  void bytes(T* first, std::size_t count) {
    file_.read(reinterpret_cast<char*>(first), static_cast<std::streamsize>(count * sizeof(T)));
  }
  std::size_t length(std::size_t) {
    std::size_t stored = 0;
    bytes(&stored, 1);
    return stored;
  }

 private:
  std::ifstream& file_;
};

template <class Archive, class Record>
void walk_record(Archive& archive, Record& record) {
  walk(archive, record.frame_times);
  walk(archive, record.rows);
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& found, const std::string& allowed) {
  throw SceneError(path.string(), {{{}, "--resume", found, allowed, ProblemSource::elsewhere}});
}

/// Hash of the first `length` bytes of a file.
std::uint64_t hash_file(std::ifstream& file, std::uint64_t length) {
  Hash hash;
  std::vector<char> block(std::size_t{1} << 20);
  while (length > 0) {
    const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(length, block.size()));
    file.read(block.data(), static_cast<std::streamsize>(count));
    hash.bytes(block.data(), count);
    length -= count;
  }
  return hash.digest();
}

struct Header {
  std::array<char, 8> magic{};
  std::uint32_t version = 0, dimension = 0;
  std::uint64_t scene = 0;
};
template <class Archive, class H>
void walk_header(Archive& archive, H& header) {
  archive.bytes(header.magic.data(), header.magic.size());
  archive.bytes(&header.version, 1);
  archive.bytes(&header.dimension, 1);
  archive.bytes(&header.scene, 1);
}

/// Leaves the file at the start of the state. The order of checks gives the reason that helps most.
void check_file(std::ifstream& file, const std::filesystem::path& path, const Scene& scene, std::uint32_t dimension) {
  if (!file) refuse(path, "no such file", "the directory of a run that was stopped with a checkpoint");
  Reader reader(file);
  Header header;
  walk_header(reader, header);
  if (!file || header.magic != magic) refuse(path, "not a checkpoint", "a checkpoint.bin written by geodrop");
  if (header.version != format_version)
    refuse(path, "checkpoint format " + std::to_string(header.version),
           "format " + std::to_string(format_version) + ": resume with the geodrop that wrote it");
  const std::uint64_t length = std::filesystem::file_size(path);
  file.seekg(0);
  const std::uint64_t computed = hash_file(file, length - sizeof(std::uint64_t));
  std::uint64_t stored = 0;
  reader.bytes(&stored, 1);
  if (stored != computed) refuse(path, "a truncated or damaged checkpoint (checksum differs)", "a whole checkpoint");
  if (header.scene != scene_hash(scene) || header.dimension != dimension)
    refuse(path, "a checkpoint of another scene", "the scene, with the same --set, that the run was started with");
  file.seekg(0);
  walk_header(reader, header);
}

}  // namespace

std::uint64_t scene_hash(const Scene& scene) { return XXH3_64bits(scene.as_run.data(), scene.as_run.size()); }

template <int Dim>
std::string state_hash(const State<Dim>& state) {
  Hash hash;
  walk(hash, state);
  std::array<char, 17> text;
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash.digest()));
  return text.data();
}

template <int Dim>
void write_checkpoint(const std::filesystem::path& path, const Scene& scene, const State<Dim>& state,
                      const OutputRecord& output) {
  AtomicFile file(path);
  Writer writer(file);
  const Header header{magic, format_version, Dim, scene_hash(scene)};
  walk_header(writer, header);
  walk(writer, state);
  walk_record(writer, output);
  const std::uint64_t checksum = writer.checksum();
  writer.bytes(&checksum, 1);
  file.commit();
}

template <int Dim>
Checkpoint<Dim> read_checkpoint(const std::filesystem::path& path, const Scene& scene) {
  std::ifstream file(path, std::ios::binary);
  check_file(file, path, scene, Dim);
  Reader reader(file);
  Checkpoint<Dim> checkpoint;
  walk(reader, checkpoint.state);
  walk_record(reader, checkpoint.output);
  return checkpoint;
}

template std::string state_hash(const State<2>&);
template std::string state_hash(const State<3>&);
template void write_checkpoint(const std::filesystem::path&, const Scene&, const State<2>&, const OutputRecord&);
template void write_checkpoint(const std::filesystem::path&, const Scene&, const State<3>&, const OutputRecord&);
template Checkpoint<2> read_checkpoint(const std::filesystem::path&, const Scene&);
template Checkpoint<3> read_checkpoint(const std::filesystem::path&, const Scene&);

}  // namespace geodrop
