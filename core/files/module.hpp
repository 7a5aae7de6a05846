// Loads modules when they are first needed. Their libraries bring two hundred others: linked into
// the program these would triple the time that each command takes to start.
#pragma once

#include <filesystem>
#include <string>

namespace dibhr {

/// The path of a file that belongs to the program: beside the program, or in ../lib/dibhr.
[[nodiscard]] std::filesystem::path part_of_program(const std::string& file);

/// When a library's own calls of other libraries are resolved.
enum class Resolve { now, when_called };

/// Loads a library by its path, or by a name for the system's loader; it stays loaded. Null: it
/// cannot be loaded, and `why_not` has the loader's text.
[[nodiscard]] void* load_library(const std::string& file, Resolve resolve, std::string& why_not);

/// The address of `symbol` in the module libNAME.so, a part of the program. The module stays
/// loaded. Throws InputError if it, or a library that it needs, is missing.
[[nodiscard]] void* symbol_in_module(const char* name, const char* symbol);

}  // namespace dibhr
