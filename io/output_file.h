#pragma once
#include <filesystem>
#include <span>

namespace cavea {

/// A file that appears whole or not at all: it grows under a temporary name in the directory of its
/// target, and publish() renames it. Destroyed before that, it leaves nothing behind.
class OutputFile {
 public:
  /// \throw OutputError if nothing can be made in that directory, or the target exists and is no
  /// regular file.
  explicit OutputFile(std::filesystem::path target);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// \throw OutputError, as on a full disk.
  void append(std::span<const char> bytes);
  /// Flushes to disk and gives the file its name. \throw OutputError
  void publish();

  const std::filesystem::path& target() const { return target_; }
  /// Where it grows; a library that wants a name may write there instead of append().
  const std::filesystem::path& temporary() const { return temporary_; }

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path target_, temporary_;
  int descriptor_ = -1;
};

}  // namespace cavea
