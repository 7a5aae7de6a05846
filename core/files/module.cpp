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

void* symbol_in_module(const char* name, const char* symbol) {
    void* module =
        dlopen(part_of_program("lib" + std::string(name) + ".so").c_str(), RTLD_LAZY | RTLD_LOCAL);
    void* found = module != nullptr ? dlsym(module, symbol) : nullptr;
    if (found == nullptr)
        throw InputError("a part of dibhr cannot be loaded: " + std::string(dlerror()) +
                         ": install dibhr again");
    return found;
}

}  // namespace dibhr
