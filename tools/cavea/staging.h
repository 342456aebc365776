#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cavea/mesh/mesh_data.h"

namespace cavea::program {

/// A hidden directory beside a file to be written: what is written there is on the same file
/// system, so that it appears under its own name by a rename. Removed with all its contents at the
/// end.
class StagingDirectory {
 public:
  /// \throw OutputError if no directory can be made beside `target`
  explicit StagingDirectory(const std::filesystem::path& target);
  ~StagingDirectory();
  StagingDirectory(const StagingDirectory&) = delete;
  StagingDirectory& operator=(const StagingDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The output files of a run: all appear under their names, or none.
class OutputSet {
 public:
  /// Lets `write` write a file out of sight, under the name that it is given.
  void add(const std::filesystem::path& name,
           const std::function<void(const std::filesystem::path&)>& write);
  /// Writes a mesh, and what its format puts beside it, out of sight. \throw OutputError
  void add_mesh(const std::filesystem::path& name, const MeshData& mesh);
  /// Writes a text out of sight. \throw OutputError
  void add_text(const std::filesystem::path& name, const std::string& text);

  /// Moves all files to their names, over older ones; if one fails, puts the older ones back.
  /// \throw OutputError
  /// \return the names, in the order of their addition
  std::vector<std::filesystem::path> publish();

 private:
  struct Move;
  std::filesystem::path stage(const std::filesystem::path& name);
  std::vector<Move> moves() const;

  struct Entry {
    std::filesystem::path directory;  ///< where the files will go
    std::unique_ptr<StagingDirectory> staging;
  };
  std::vector<Entry> entries_;
};

}  // namespace cavea::program
