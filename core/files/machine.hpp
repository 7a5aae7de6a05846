// The machine on which the program runs, its environment variables and its user's folders.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dibhr {

/// An unknown text is empty.
struct Machine {
    std::string system{};  ///< "Debian GNU/Linux 12 (bookworm)"
    std::string kernel{};  ///< "Linux 6.1.0 x86_64"
    std::string cpu{};     ///< the processor's model
};

[[nodiscard]] Machine this_machine();

/// A variable of the environment; empty where it is not set.
[[nodiscard]] std::string_view environment_variable(const char* name);

/// The user's home folder; "/" where HOME is no absolute path.
[[nodiscard]] std::filesystem::path home_folder();

/// The program's own folder in the folder of an XDG variable, where that is an absolute path, else
/// in `usual` of the home folder: ("XDG_CACHE_HOME", ".cache") is ~/.cache/dibhr.
[[nodiscard]] std::filesystem::path program_folder(const char* variable,
                                                   const std::filesystem::path& usual);

}  // namespace dibhr
