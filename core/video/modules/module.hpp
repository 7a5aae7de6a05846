// What is loaded when it is first needed, as the libraries below it bring two hundred others:
// linked into the program they would triple the time that each command takes to start.
#pragma once

#include <filesystem>
#include <string>

namespace dibhr {

/// A file that belongs to the program: it lies beside it, or in ../lib/dibhr.
[[nodiscard]] std::filesystem::path part_of_program(const std::string& file);

/// The address of `symbol` in the module libNAME.so, a part of the program. The module stays
/// loaded. Throws InputError if it is missing, or what it needs.
[[nodiscard]] void* symbol_in_module(const char* name, const char* symbol);

}  // namespace dibhr
