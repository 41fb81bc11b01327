#include <geodrop/base/error.hpp>
#include <geodrop/base/input_file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace geodrop {
namespace {

/// In words, for one that is no regular file.
std::string kind_of(mode_t mode) {
  const std::string but = ", not a regular file";
  if (S_ISDIR(mode)) return "a directory" + but;
  if (S_ISFIFO(mode)) return "a pipe" + but;
  if (S_ISSOCK(mode)) return "a socket" + but;
  return "a device" + but;
}

std::string reason(int error) {
  if (error == ENOENT || error == ENOTDIR) return "no such file";
  if (error == ENXIO) return "a socket or a device, not a regular file";
  return std::string("no readable file (") + std::strerror(error) + ")";
}

std::string in_megabytes(std::uint64_t bytes) {
  constexpr std::uint64_t megabyte = 1000000;
  return std::to_string(bytes / megabyte) + " MB";
}

}  // namespace

InputFile open_input(const std::filesystem::path& path) {
  InputFile input;
  // Without O_NONBLOCK a pipe that nobody writes to is waited for here; regular files do not know it.
  const int descriptor = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor < 0) {
    input.fault = reason(errno);
    return input;
  }
  struct stat status {};
  if (fstat(descriptor, &status) != 0) {
    input.fault = reason(errno);
  } else if (!S_ISREG(status.st_mode)) {
    input.fault = kind_of(status.st_mode);
  } else {
    input.size = static_cast<std::uint64_t>(status.st_size);
    input.file.reset(fdopen(descriptor, "rb"));
    if (input.file) return input;
    input.fault = reason(errno);
  }
  close(descriptor);
  return input;
}

std::string read_input(const std::filesystem::path& path, const std::string& key, const std::string& allowed,
                       std::uint64_t most) {
  const auto refuse = [&](const std::string& found) {
    throw SceneError(path.string(), {{{}, key, found, allowed, ProblemSource::elsewhere}});
  };
  const InputFile input = open_input(path);
  if (!input.file) refuse(input.fault);
  std::string text;
  // Files of /proc say that they are empty, others may grow meanwhile: what is read counts, not what was said.
  constexpr std::size_t at_once = std::size_t{1} << 16;
  for (std::size_t count = 1; count > 0 && text.size() <= most;) {
    const std::size_t before = text.size();
    text.resize(before + at_once);
    count = std::fread(text.data() + before, 1, at_once, input.file.get());
    text.resize(before + count);
  }
  if (std::ferror(input.file.get())) refuse(reason(errno));
  if (text.size() > most) refuse("a file of more than " + in_megabytes(most));
  return text;
}

}  // namespace geodrop
