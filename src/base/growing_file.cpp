#include "growing_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "atomic_file.hpp"

namespace geodrop {
namespace {

/// Whether all of it was written.
bool write_all(int descriptor, const std::string& text) {
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = write(descriptor, text.data() + written, text.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    written += static_cast<std::size_t>(count);
  }
  return true;
}

int open_growing(const std::filesystem::path& path, GrowingFile::Begin begin) {
  constexpr int all_that_umask_leaves = 0666;
  const int how = begin == GrowingFile::Begin::anew ? O_TRUNC : 0;
  return open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC | how, all_that_umask_leaves);
}

}  // namespace

GrowingFile::GrowingFile(std::filesystem::path path, Begin begin)
    : path_(std::move(path)), descriptor_(open_growing(path_, begin)) {
  if (descriptor_ < 0) throw_not_written(path_, errno);
  size_ = lseek(descriptor_, 0, SEEK_END);
}

GrowingFile::~GrowingFile() { close(descriptor_); }

void GrowingFile::append(const std::string& text) {
  pending_ += text;
  if (write_all(descriptor_, pending_)) {
    size_ += static_cast<long>(pending_.size());
    pending_.clear();
    return;
  }
  if (failure_.empty()) failure_ = "cannot write " + path_.string() + ": " + std::strerror(errno);
  if (ftruncate(descriptor_, size_) != 0) return;  // a device, which has no length
}

}  // namespace geodrop
