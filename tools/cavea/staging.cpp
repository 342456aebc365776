#include "staging.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "cavea/base/error.h"
#include "cavea/io/formats.h"

namespace cavea::program {

namespace fs = std::filesystem;

namespace {

fs::path directory_of(const fs::path& file) {
  const fs::path parent = file.parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

/// Keeps the file under a second name, so that it survives a rename over its first one.
void keep(const fs::path& file, const fs::path& second_name) {
  std::error_code error;
  fs::create_hard_link(file, second_name, error);
  if (error) fs::copy_file(file, second_name);  // not every file system has hard links
}

}  // namespace

StagingDirectory::StagingDirectory(const fs::path& target) {
  std::string name = (directory_of(target) / ".cavea-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw OutputError(fmt::format("cannot write into the directory {}: {}",
                                  directory_of(target).string(),
                                  std::generic_category().message(errno)));
  path_ = name;
}

StagingDirectory::~StagingDirectory() {
  std::error_code ignored;  // a destructor has nobody to tell
  fs::remove_all(path_, ignored);
}

/// One file on its way: `backup` is where the older file of that name is kept meanwhile.
struct OutputSet::Move {
  fs::path from, to, backup;

  void perform() {
    if (fs::exists(fs::symlink_status(to))) keep(to, backup);
    fs::rename(from, to);
  }
  void undo() const {
    std::error_code ignored;  // nothing better can be done while an error is on its way
    if (fs::exists(fs::symlink_status(backup, ignored)))
      fs::rename(backup, to, ignored);
    else
      fs::remove(to, ignored);
  }
};

fs::path OutputSet::stage(const fs::path& name) {
  entries_.push_back({directory_of(name), std::make_unique<StagingDirectory>(name)});
  return entries_.back().staging->path() / name.filename();
}

void OutputSet::add(const fs::path& name, const std::function<void(const fs::path&)>& write) {
  write(stage(name));
}

void OutputSet::add_mesh(const fs::path& name, const MeshData& mesh) {
  write_mesh(stage(name), mesh);
}

void OutputSet::add_text(const fs::path& name, const std::string& text) {
  std::ofstream file(stage(name), std::ios::binary);
  file << text;
  file.close();
  if (!file) throw OutputError(fmt::format("{}: cannot be written", name.string()));
}

std::vector<OutputSet::Move> OutputSet::moves() const {
  std::vector<Move> all;
  for (const Entry& entry : entries_) {
    const fs::path old = entry.staging->path() / ".older";
    std::vector<fs::path> files;
    for (const auto& file : fs::directory_iterator(entry.staging->path()))
      files.push_back(file.path().filename());
    std::sort(files.begin(), files.end());
    fs::create_directory(old);
    for (const fs::path& file : files)
      all.push_back({entry.staging->path() / file, entry.directory / file, old / file});
  }
  return all;
}

std::vector<fs::path> OutputSet::publish() {
  std::vector<Move> all;
  std::size_t done = 0;
  try {
    all = moves();
    for (; done < all.size(); ++done) all[done].perform();
  } catch (const fs::filesystem_error& e) {
    while (done > 0) all[--done].undo();
    throw OutputError(fmt::format("{}: {}", e.path1().string(), e.code().message()));
  }
  std::vector<fs::path> names;
  for (const Move& move : all) names.push_back(move.to.lexically_normal());
  entries_.clear();
  return names;
}

}  // namespace cavea::program
