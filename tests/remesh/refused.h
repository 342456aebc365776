#pragma once
#include <gtest/gtest.h>

#include <string>

#include "cavea/base/error.h"
#include "cavea/remesh/options.h"

namespace cavea::test {

/// Options that `set` makes senseless are refused, by a message with `named` in it.
template <class Set>
void expect_refused(Set&& set, const std::string& named) {
  Options options;
  set(options);
  try {
    validate(options);
    ADD_FAILURE() << named << " was taken";
  } catch (const OptionError& e) {
    EXPECT_NE(std::string(e.what()).find(named), std::string::npos) << e.what();
  }
}

}  // namespace cavea::test
