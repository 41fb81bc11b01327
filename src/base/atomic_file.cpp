#include "atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <fstream>
#include <iterator>

#include <cerrno>
#include <cstring>
#include <geodrop/base/error.hpp>
#include <utility>

namespace geodrop {
namespace {

std::FILE* create(const std::filesystem::path& path) {
  constexpr int all_that_umask_leaves = 0666;
  unlink(path.c_str());
  const int descriptor =
      open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, all_that_umask_leaves);
  return descriptor < 0 ? nullptr : fdopen(descriptor, "wb");
}

}  // namespace

void throw_not_written(const std::filesystem::path& path, int error) {
  throw WriteError("cannot write " + path.string() + ": " + std::strerror(error));
}

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)), temporary_(path_.string() + ".part"), file_(create(temporary_)) {
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

std::string AtomicFile::name_for_others() const { return "/proc/self/fd/" + std::to_string(fileno(file_.get())); }

void AtomicFile::commit() {
  // On disk before the name changes, or a power cut could leave the new name with no content.
  if (std::fflush(file_.get()) != 0 || fsync(fileno(file_.get())) != 0) throw_not_written(path_, errno);
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) throw_not_written(path_, error.value());
  file_.reset();
  sync_directory(path_.parent_path());
}

std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_file_atomically(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

void sync_directory(const std::filesystem::path& directory) {
  const char* name = directory.empty() ? "." : directory.c_str();
  const int descriptor = open(name, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) throw_not_written(directory, errno);
  // Some file systems of a network have no such thing and say EINVAL.
  const int error = fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
  close(descriptor);
  if (error != 0) throw_not_written(directory, error);
}

}  // namespace geodrop
