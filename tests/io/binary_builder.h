#pragma once
// Medit binary files of any version and byte order, made independently of the library's writer.
#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <string>

namespace cavea::test {

class BinaryBuilder {
 public:
  BinaryBuilder(int version, bool swapped) : version_(version), swapped_(swapped) {
    put(std::int32_t{1});
    put(std::int32_t{version});
  }
  /// A keyword with its position; `body` appends what follows, and tells how many bytes it is.
  template <class Body>
  BinaryBuilder& keyword(std::int32_t code, Body&& body) {
    put(code);
    const std::size_t slot = bytes_.size();
    position(0);
    body();
    patch(slot, bytes_.size());
    return *this;
  }
  BinaryBuilder& dimension(std::int32_t d) {
    return keyword(3, [&] { put(d); });
  }
  /// A section of rows of whole numbers.
  BinaryBuilder& rows(std::int32_t code, std::int64_t count,
                      std::initializer_list<std::int64_t> all) {
    return keyword(code, [&] {
      integer(count);
      for (const std::int64_t i : all) integer(i);
    });
  }
  BinaryBuilder& vertices(std::int64_t count, std::initializer_list<double> xyz) {
    return keyword(4, [&] {
      integer(count);
      int k = 0;
      for (const double x : xyz) {
        real(x);
        if (++k % 3 == 0) integer(k / 3);
      }
    });
  }
  BinaryBuilder& end() {
    put(std::int32_t{54});
    position(0);
    return *this;
  }
  void integer(std::int64_t i) { version_ >= 4 ? put(i) : put(std::int32_t(i)); }
  void real(double x) { version_ == 1 ? put(float(x)) : put(x); }
  void small(std::int32_t i) { put(i); }
  const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  std::string encoded(T value) const {
    std::string raw(sizeof value, '\0');
    std::memcpy(raw.data(), &value, sizeof value);
    if (swapped_) std::reverse(raw.begin(), raw.end());
    return raw;
  }
  template <class T>
  void put(T value) {
    bytes_ += encoded(value);
  }
  std::string encoded_position(std::size_t at) const {
    return version_ >= 3 ? encoded(std::int64_t(at)) : encoded(std::int32_t(at));
  }
  void position(std::size_t at) { bytes_ += encoded_position(at); }
  void patch(std::size_t slot, std::size_t at) {
    const std::string raw = encoded_position(at);
    bytes_.replace(slot, raw.size(), raw);
  }

  int version_;
  bool swapped_;
  std::string bytes_;
};

}  // namespace cavea::test
