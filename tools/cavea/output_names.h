#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace cavea::program {

/// A file that a command reads or writes, and how to call it in a message.
struct NamedFile {
  std::string role;  ///< "the input", "-o", "--report", ...
  std::filesystem::path path;
};

/// Refuses, before any work, a run that could not end well: an output that is an input or another
/// output under whatever name (links, symbolic links, ./), one that exists and is no regular file,
/// one in a directory that is missing or not writable. \throw OptionError naming the file.
void check_outputs(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// Where the sizes at the vertices of a mesh file are; empty if its format has no such file.
std::filesystem::path sizes_beside(const std::filesystem::path& mesh);

/// The files that a mesh written under `name` consists of: itself, and the sizes beside a Medit
/// one. \throw OptionError if the extension is not one that can be written
std::vector<NamedFile> files_of_mesh(const std::filesystem::path& name);

}  // namespace cavea::program
