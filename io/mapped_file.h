#pragma once
#include <cstddef>
#include <filesystem>
#include <span>

namespace cavea {

/// The bytes of a file as a private memory map: writing to them does not change the file.
class MappedFile {
 public:
  /// \throw InputError if the path is no regular file, cannot be read or is empty.
  explicit MappedFile(const std::filesystem::path& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  std::span<char> bytes() const { return bytes_; }

 private:
  std::span<char> bytes_;
};

}  // namespace cavea
