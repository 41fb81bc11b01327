// A file that appears under its name only when it is whole: written beside it, then renamed.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace geodrop {

class AtomicFile {
 public:
  /// Throws RunError, as all functions here, if the disk does not take it.
  explicit AtomicFile(std::filesystem::path path);
  /// Removes what was written unless it was committed.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* first, std::size_t bytes);
  void commit();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_, temporary_;
  std::unique_ptr<std::FILE, Close> file_;
};

void write_file_atomically(const std::filesystem::path& path, const std::string& text);

}  // namespace geodrop
