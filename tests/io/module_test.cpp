#include "cavea/base/module.h"

#include <gtest/gtest.h>

#include <string>

#include "cavea/base/error.h"

namespace cavea {
namespace {

TEST(Module, ThatIsNotThereIsNamedInATypedError) {
  try {
    module_symbol("cavea_of_nowhere", "anything");
    FAIL() << "opened";
  } catch (const OptionError& e) {
    EXPECT_NE(std::string(e.what()).find("cavea_of_nowhere.so"), std::string::npos) << e.what();
  }
}

#ifdef CAVEA_HAVE_VTK
TEST(Module, WithoutThatSymbolSaysSo) {
  EXPECT_NE(module_symbol("cavea_vtk", "cavea_write_vtu"), nullptr);
  EXPECT_THROW(module_symbol("cavea_vtk", "cavea_read_vtu"), OptionError);
}
#endif

}  // namespace
}  // namespace cavea
