// Files that are no checkpoint of this program, and checkpoints with a right checksum that no run wrote.
#include <geodrop/base/error.hpp>
#include <geodrop/files/checkpoint.hpp>

#include "files/build_identity.hpp"
#include "support/scene_files.hpp"
#include "support/small_state.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>

#include <sys/stat.h>
#include <xxhash.h>

#include <cstring>

using namespace geodrop;
using geodrop::test::contains;

namespace {

std::string refusal(const std::filesystem::path& path) {
  try {
    read_checkpoint<2>(path, small_scene());
  } catch (const SceneError& error) {
    return error.problems().at(0).found;
  }
  return "";
}

/// The bytes of a checkpoint of the small scene without its checksum.
std::string small_bytes() {
  const TemporaryDirectory directory;
  write_checkpoint(directory / "checkpoint.bin", small_scene(), small_state(), {{0}, {}});
  std::string bytes = read_file(directory / "checkpoint.bin");
  bytes.resize(bytes.size() - sizeof(std::uint64_t));
  return bytes;
}

/// Reads them with the checksum that they should have.
template <class Read>
auto with_sum(const std::string& bytes, Read read) {
  const TemporaryDirectory directory;
  const std::uint64_t sum = XXH3_64bits(bytes.data(), bytes.size());
  std::string whole = bytes;
  whole.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  std::ofstream(directory / "checkpoint.bin", std::ios::binary) << whole;
  return read(directory / "checkpoint.bin");
}

/// `bytes` with a word of eight bytes replaced where `text` begins, `before` bytes earlier.
std::string with_word(std::string bytes, const std::string& text, std::size_t before, std::uint64_t word) {
  const std::size_t at = bytes.find(text);
  REQUIRE(at != std::string::npos);
  std::memcpy(bytes.data() + at - before, &word, sizeof word);
  return bytes;
}

}  // namespace

TEST_CASE("What is no regular file is told apart at once") {
  const TemporaryDirectory directory;
  const std::filesystem::path pipe = directory / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR) == 0);
  CHECK(refusal(pipe) == "a pipe, not a regular file");
  CHECK(refusal(directory / "") == "a directory, not a regular file");
  CHECK(refusal("/dev/zero") == "a device, not a regular file");
  CHECK(refusal(directory / "none") == "no such file");
}

TEST_CASE("Lengths beyond the file, and bytes beyond the content, are refused") {
  const std::string bytes = small_bytes();
  CHECK(with_sum(bytes, refusal) == "");
  // The length of a text stands right before it.
  for (const std::uint64_t length : {std::uint64_t{1} << 60, ~std::uint64_t{0}, std::uint64_t{100000}})
    CHECK(contains(with_sum(with_word(bytes, "pool", 8, length), refusal),
                   "a damaged checkpoint: a list of " + std::to_string(length) + ", longer than the file"));
  CHECK(contains(with_sum(bytes + "12345678", refusal), "a damaged checkpoint: 8 bytes more than a checkpoint has"));
  CHECK(contains(with_sum(bytes.substr(0, bytes.size() - 9), refusal), "a damaged checkpoint: a list "));
  // The number of the law stands behind the name of the material.
  std::string other_law = bytes;
  const std::uint32_t law = 77;
  std::memcpy(other_law.data() + bytes.find("water") + 5, &law, sizeof law);
  CHECK(with_sum(other_law, refusal) == "a damaged checkpoint: a material of law number 77");
}

TEST_CASE("A checkpoint of another build is read with a warning") {
  const auto warning = [](const std::filesystem::path& path) {
    return read_checkpoint<2>(path, small_scene()).warning;
  };
  std::string bytes = small_bytes();
  CHECK(with_sum(bytes, warning) == "");
  const std::string sums = this_build().sums;
  const std::size_t at = bytes.find(sums);
  REQUIRE(at != std::string::npos);
  bytes[at] = '?';
  const std::string text = with_sum(bytes, warning);
  CHECK(contains(text, "sums ?" + sums.substr(1) + " instead of " + sums));
  CHECK(text.find('\n') == std::string::npos);
}
