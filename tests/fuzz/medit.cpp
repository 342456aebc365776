// Entry of libFuzzer: the first byte chooses the reader. The suite calls it too.
#include "cavea/base/error.h"
#include "io/in_memory.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  if (size == 0) return 0;
  using cavea::test::Encoding;
  const std::string_view input(reinterpret_cast<const char*>(data) + 1, size - 1);
  const Encoding encoding = data[0] & 1 ? Encoding::bytes : Encoding::text;
  try {
    if (data[0] & 2)
      cavea::test::parse_sizes(input, encoding, 5);
    else
      cavea::test::parse(input, encoding);
  } catch (const cavea::InputError&) {  // the right answer to a damaged file
  }
  return 0;
}
