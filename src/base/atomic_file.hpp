// A file that appears under its name only when it is whole: written beside it, then renamed.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace geodrop {

/// A FILE that closes itself.
struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

class AtomicFile {
 public:
  /// Begins NAME.part. One that a killed run left is removed; a link is never followed, since it may lead to anything
  /// where others may write. Throws WriteError, as all functions here, if the disk does not take it.
  explicit AtomicFile(std::filesystem::path path);
  /// Removes what was written unless it was committed.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* first, std::size_t bytes);
  /// A name for whoever writes by a name: it leads to this file, whatever stands under NAME.part by then.
  std::string name_for_others() const;
  /// On disk, under its name, when this returns: a power cut takes neither content nor name away.
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  std::unique_ptr<std::FILE, CloseFile> file_;
};

/// All of a file; empty if it cannot be read.
std::string text_of_file(const std::filesystem::path& path);

void write_file_atomically(const std::filesystem::path& path, const std::string& text);

/// Puts on disk which names a directory holds.
void sync_directory(const std::filesystem::path& directory);

[[noreturn]] void throw_not_written(const std::filesystem::path& path, int error);

}  // namespace geodrop
