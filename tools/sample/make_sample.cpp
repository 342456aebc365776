// Writes the sample mesh: make_sample OUT.mesh. The file in the repository is what it writes.
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "cavea/io/formats.h"
#include "distort.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_sample OUT.mesh\n");
    return 2;
  }
  try {
    cavea::sample::Bracket bracket = cavea::sample::make_bracket();
    cavea::sample::distort(bracket);
    cavea::write_mesh(argv[1], bracket.mesh);
  } catch (const std::exception& e) {
    fmt::print(stderr, "make_sample: {}\n", e.what());
    return 3;
  }
  return 0;
}
