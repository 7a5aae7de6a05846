// A library that the maker of a device gives to its owners: found and loaded at run time, because
// it may not be passed on with dibhr.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace dibhr {

/// Where a maker's library may be.
struct MakersLibrarySearch {
    /// A library that is not installed is reported by the name of its package.
    struct Package {
        const char* library;  ///< "libusb-1.0.so.0"
        const char* package;  ///< "libusb-1.0-0"
    };

    /// Its file names, best first: "libdrd.so.3". In a folder, a file with more numbers behind the
    /// name ("libdrd.so.3.17.6") is the same library.
    std::vector<std::string> names{};
    std::string chosen{};                    ///< a file or a folder, from the settings; empty: none
    std::vector<const char*> variables{};    ///< of the environment, each with a folder
    std::vector<std::string> sub_folders{};  ///< of a folder, in which the library may be; ""
    /// The usual folders; "~/" is the home folder, and "*" at the end any ending, newest first.
    std::vector<std::string> folders{};
    std::vector<Package> packages{};  ///< of the libraries that it needs
};

/// A library stays loaded until the program ends: makers' libraries do not stand a second start.
struct MakersLibrary {
    void* handle{nullptr};         ///< null: none was loaded
    std::filesystem::path file{};  ///< as opened
    /// Why the installed library was not loaded, in one sentence with the next step. Empty while
    /// `handle` is null: none is installed.
    std::string trouble{};
};

/// Why the system's loader cannot load this file, in one sentence with the next step; empty: it may
/// be able to. The file is read, no code of it is run.
[[nodiscard]] std::string why_no_library(const std::filesystem::path& file);

/// Loads the first library that can be used, in this order: `chosen`, the environment's folders,
/// the system's loader, the usual folders; in each, the names in their order. Where one is chosen,
/// no other is tried. `why_not` returns why a loaded library cannot be used, or nothing.
[[nodiscard]] MakersLibrary load_makers_library(
    const MakersLibrarySearch& search,
    const std::function<std::string(const MakersLibrary&)>& why_not);

/// Fills a struct of function pointers from a library.
class LibrarySymbols {
  public:
    explicit LibrarySymbols(void* handle) : handle_(handle) {}

    /// A null pointer where the library has no such function.
    template <typename Function>
    void optional(Function*& function, const char* name) const noexcept {
        function = reinterpret_cast<Function*>(address(name));
    }
    template <typename Function>
    void required(Function*& function, const char* name) {
        optional(function, name);
        if (function == nullptr && missing_.empty()) missing_ = name;
    }
    template <typename Function>
    void required(std::function<Function>& function, const char* name) {
        Function* found = nullptr;
        required(found, name);
        if (found != nullptr) function = found;
    }
    /// The first required function that the library does not have; empty: it has all.
    [[nodiscard]] const std::string& missing() const noexcept { return missing_; }

  private:
    [[nodiscard]] void* address(const char* name) const noexcept;

    void* handle_;
    std::string missing_{};
};

}  // namespace dibhr
