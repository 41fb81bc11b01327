#include "atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <geodrop/error.hpp>
#include <utility>

namespace geodrop {
namespace {

[[noreturn]] void throw_not_written(const std::filesystem::path& path, int error) {
  throw RunError("cannot write " + path.string() + ": " + std::strerror(error));
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)), temporary_(path_.string() + ".part"), file_(std::fopen(temporary_.c_str(), "wb")) {
  if (!file_) throw_not_written(path_, errno);
}

AtomicFile::~AtomicFile() {
  if (!file_) return;
  file_.reset();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::write(const void* first, std::size_t bytes) {
  if (bytes > 0 && std::fwrite(first, 1, bytes, file_.get()) != bytes) throw_not_written(path_, errno);
}

void AtomicFile::commit() {
  // On disk before the name changes, or a power cut could leave the new name with no content.
  if (std::fflush(file_.get()) != 0 || fsync(fileno(file_.get())) != 0) throw_not_written(path_, errno);
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) throw_not_written(path_, error.value());
  file_.reset();
}

void write_file_atomically(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace geodrop
