// What is loaded when it is first needed, as the libraries below it bring two hundred others:
// linked into the program they would triple the time that each command takes to start.
#pragma once

namespace dibhr {

/// The address of `symbol` in the module libNAME.so, which lies beside the program or in
/// ../lib/dibhr. The module stays loaded. Throws InputError if it is missing, or what it needs.
[[nodiscard]] void* symbol_in_module(const char* name, const char* symbol);

}  // namespace dibhr
