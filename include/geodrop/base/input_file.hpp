// Files that a user names. A pipe would be waited for without end, and a device such as /dev/zero read until memory is
// full: only regular files are taken.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace geodrop {

struct InputFile {
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file;
  std::uint64_t size = 0;  ///< when it was opened [byte]
  std::string fault;       ///< why it could not be opened, e.g. "no such file"; empty: it is open
};

/// Returns at once whatever the path is.
InputFile open_input(const std::filesystem::path& path);

/// Larger texts are none that this program wrote or a person would write [byte].
inline constexpr std::uint64_t largest_text = std::uint64_t{64} << 20;

/// The whole text of a file. Throws SceneError, with `key` and with what is `allowed` there, if it is no regular file,
/// cannot be read or is larger than `most`.
std::string read_input(const std::filesystem::path& path, const std::string& key, const std::string& allowed,
                       std::uint64_t most = largest_text);

}  // namespace geodrop
