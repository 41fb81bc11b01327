#include "run_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <geodrop/base/error.hpp>
#include <utility>

#include "base/atomic_file.hpp"

namespace geodrop {
namespace {

bool same(const struct stat& one, const struct stat& other) {
  return one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

/// What the holder wrote, e.g. "process 4711 on host weir".
std::string holder(int file) {
  std::array<char, 300> text{};
  const ssize_t count = pread(file, text.data(), text.size(), 0);
  const std::string said(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  return said.substr(0, said.find('\n'));
}

[[noreturn]] void refuse_second_run(const std::filesystem::path& directory, const std::string& who) {
  throw SceneError(directory.string(),
                   {{{},
                     "--output",
                     "a directory in which another run is at work" + (who.empty() ? "" : " (" + who + ")"),
                     "a directory of its own for each run",
                     ProblemSource::elsewhere}});
}

}  // namespace

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::optional<std::string> run_at_work(const std::filesystem::path& directory) {
  const int file = open((directory / RunLock::file_name).c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) return std::nullopt;
  const bool held = flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  const std::string who = held ? holder(file) : "";
  close(file);
  return held ? std::optional(who) : std::nullopt;
}

RunLock::RunLock(const std::filesystem::path& directory) {
  while (!try_to_take(directory)) close_both();
  const std::string text = "process " + std::to_string(getpid()) + " on host " + host_name() + "\n";
  // A lock without a name is a lock all the same.
  if (ftruncate(file_, 0) != 0 || pwrite(file_, text.data(), text.size(), 0) < 0) return;
}

RunLock::~RunLock() {
  if (file_ < 0) return;
  unlinkat(directory_, file_name, 0);  // before the lock is dropped, so that nobody's else is taken away
  close_both();
}

RunLock::RunLock(RunLock&& other) noexcept
    : directory_(std::exchange(other.directory_, -1)), file_(std::exchange(other.file_, -1)) {}

/// False if its last holder took the file or the directory away meanwhile.
bool RunLock::try_to_take(const std::filesystem::path& directory) {
  constexpr int all_that_umask_leaves = 0666;
  directory_ = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory_ < 0) throw_not_written(directory, errno);
  file_ = openat(directory_, file_name, O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, all_that_umask_leaves);
  if (file_ < 0) {
    const int error = errno;
    close_both();
    throw_not_written(directory / file_name, error);
  }
  if (flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    const std::string who = holder(file_);
    close_both();
    refuse_second_run(directory, who);
  }
  struct stat locked {
  }, named{}, opened{}, at_path{};
  return fstat(file_, &locked) == 0 && fstatat(directory_, file_name, &named, AT_SYMLINK_NOFOLLOW) == 0 &&
         same(locked, named) && fstat(directory_, &opened) == 0 && stat(directory.c_str(), &at_path) == 0 &&
         same(opened, at_path);
}

void RunLock::close_both() {
  if (file_ >= 0) close(file_);
  if (directory_ >= 0) close(directory_);
  file_ = directory_ = -1;
}

}  // namespace geodrop
