#include "cavea/io/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <system_error>

#include "cavea/base/error.h"

namespace cavea {
namespace {

namespace fs = std::filesystem;

/// A short name, so that it fits wherever the target's name does; hidden, for whoever lists the
/// directory meanwhile.
fs::path random_sibling(const fs::path& target) {
  std::random_device random;
  return target.parent_path() / fmt::format(".cavea-{:08x}{:08x}", random(), random());
}

}  // namespace

OutputFile::OutputFile(fs::path target) : target_(std::move(target)) {
  std::error_code ignored;  // what cannot be looked at cannot be created either: open() says why
  const fs::file_status status = fs::status(target_, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw OutputError(fmt::format("{}: exists and is not a regular file", target_.string()));
  do {
    temporary_ = random_sibling(target_);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && (errno == EEXIST || errno == EINTR));
  if (descriptor_ < 0) fail(errno);
}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
}

void OutputFile::append(std::span<const char> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    bytes = bytes.subspan(std::size_t(written));
  }
}

void OutputFile::publish() {
  // Some file systems have no fsync and say EINVAL: then there is nothing to wait for.
  if (::fsync(descriptor_) != 0 && errno != EINVAL) fail(errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0 && errno != EINTR) fail(errno);
}

void OutputFile::fail(int error) const {
  throw OutputError(fmt::format("{}: cannot be written: {}", target_.string(),
                                std::generic_category().message(error)));
}

}  // namespace cavea
