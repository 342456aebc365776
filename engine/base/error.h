#pragma once
#include <stdexcept>
#include <string>

namespace cavea {

/// Base of every error that the library throws on purpose. The library never prints or exits.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The caller's data is at fault: a file that cannot be read, a mesh that is no mesh. The message
/// names the file, the line or byte offset, and the entity.
class InputError : public Error {
 public:
  using Error::Error;
};

/// The caller's options contradict each other or make no sense.
class OptionError : public Error {
 public:
  using Error::Error;
};

/// More is asked for than ids can name or memory can hold. The message has the estimate; nothing was
/// allocated for it.
class MemoryError : public Error {
 public:
  using Error::Error;
};

/// A file could not be written; nothing was left under its name.
class OutputError : public Error {
 public:
  using Error::Error;
};

/// Our own fault: an invariant of the engine does not hold.
class InternalError : public Error {
 public:
  using Error::Error;
};

/// The caller raised the cancel flag.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

}  // namespace cavea
