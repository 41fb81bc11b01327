// A file that grows by whole texts while a run goes on: log, history.
#pragma once

#include <filesystem>
#include <string>

namespace geodrop {

class GrowingFile {
 public:
  enum class Begin { anew, behind };

  /// Throws WriteError if it cannot be opened.
  GrowingFile(std::filesystem::path path, Begin begin);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// What the disk does not take is kept and tried again before the next text; no part of it stays in the file.
  void append(const std::string& text);
  /// Why something was not taken, the first time; empty if everything was.
  const std::string& failure() const { return failure_; }

 private:
  std::filesystem::path path_;
  int descriptor_;
  long size_;  ///< of whole texts
  std::string pending_, failure_;
};

}  // namespace geodrop
