#pragma once
#include <string>

namespace cavea {

/// A symbol of one of our modules: a shared object that brings a large library along, and is opened
/// when it is first asked for, since else all runs would pay for its loading (OpenVDB: 30 MB and
/// 40 ms). It is `<module>.so` in ../lib/cavea, seen from the program's folder, or else wherever
/// the dynamic loader looks. It stays open. Any number of threads may ask at once. \throw
/// OptionError that says why it cannot be opened, or that it has no such symbol
void* module_symbol(const std::string& module, const char* symbol);

}  // namespace cavea
