// Finds a module and loads it.
#include "core/files/module.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "core/error.hpp"

namespace dibhr {

namespace fs = std::filesystem;

/// Beside the program in a build folder; in lib/dibhr when installed.
fs::path part_of_program(const std::string& file) {
    std::error_code ignored;
    const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    if (fs::exists(folder / file, ignored)) return folder / file;
    return folder.parent_path() / "lib" / "dibhr" / file;
}

void* load_library(const std::string& file, Resolve resolve, std::string& why_not) {
    const int when = resolve == Resolve::now ? RTLD_NOW : RTLD_LAZY;
    void* const library = dlopen(file.c_str(), when | RTLD_LOCAL);
    if (library == nullptr) why_not = dlerror();
    return library;
}

void* symbol_in_module(const char* name, const char* symbol) {
    std::string why_not;
    void* module = load_library(part_of_program("lib" + std::string(name) + ".so"),
                                Resolve::when_called, why_not);
    void* found = module != nullptr ? dlsym(module, symbol) : nullptr;
    if (module != nullptr && found == nullptr) why_not = std::string("it has no ") + symbol;
    if (found == nullptr)
        throw InputError("a part of dibhr cannot be loaded: " + why_not + ": install dibhr again");
    return found;
}

}  // namespace dibhr
