#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "text_table.h"

namespace cavea::program {
namespace {

constexpr double kRewriteSeconds = 0.1;  // faster than this nobody can read
constexpr const char* kClearLine = "\r\033[K";

std::string line(const Progress& p) {
  const double rate = p.seconds > 0 ? static_cast<double>(p.tets) / p.seconds : 0;
  return fmt::format("{} round {}: {} tets, {} tets/s, {:.1f} s", p.phase, p.round, grouped(p.tets),
                     grouped(static_cast<std::int64_t>(rate)), p.seconds);
}

}  // namespace

ProgressPrinter::ProgressPrinter() : terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressPrinter::~ProgressPrinter() {
  if (line_open_) std::fputs(kClearLine, stderr);
}

void ProgressPrinter::show(const Progress& progress) {
  const bool new_phase = phase_ != progress.phase;
  if (!new_phase && (!terminal_ || progress.seconds - shown_at_ < kRewriteSeconds)) return;
  phase_ = progress.phase;
  shown_at_ = progress.seconds;
  line_open_ = terminal_;
  // stdio, not fmt: a standard error that cannot be written to must not end the run.
  const std::string text =
      terminal_ ? kClearLine + line(progress) : "cavea: " + line(progress) + "\n";
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace cavea::program
