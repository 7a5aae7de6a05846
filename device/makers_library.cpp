// Finds a maker's library, checks its file and loads it.
#include "device/makers_library.hpp"

#include <dlfcn.h>
#include <elf.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

#include "core/files/machine.hpp"
#include "core/files/module.hpp"
#include "device/hand/shell_word.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

#if defined(__x86_64__)
constexpr int kOwnMachine = EM_X86_64;
constexpr const char* kOwnMachineName = "x86-64";
#elif defined(__aarch64__)
constexpr int kOwnMachine = EM_AARCH64;
constexpr const char* kOwnMachineName = "ARM (64 bit)";
#else
#error "Add the number and the name of this processor in ELF files"
#endif

template <typename Part>
std::optional<Part> read_part(std::ifstream& stream, std::uint64_t from) {
    Part part{};
    stream.seekg(static_cast<std::streamoff>(from));
    if (!stream.read(reinterpret_cast<char*>(&part), sizeof part)) return std::nullopt;
    return part;
}

/// Of a file that is shorter the loader would touch pages that do not exist.
bool is_whole(std::ifstream& stream, const Elf64_Ehdr& head, std::uint64_t size) {
    if (head.e_phnum == 0 || head.e_phentsize != sizeof(Elf64_Phdr)) return false;
    // The table of sections is usually the last part of a file.
    const std::uint64_t sections = std::uint64_t{head.e_shnum} * head.e_shentsize;
    if (head.e_shoff > size || sections > size - head.e_shoff) return false;
    for (std::uint64_t k = 0; k < head.e_phnum; ++k) {
        const auto part = read_part<Elf64_Phdr>(stream, head.e_phoff + k * sizeof(Elf64_Phdr));
        if (!part) return false;
        if (part->p_offset > size || part->p_filesz > size - part->p_offset) return false;
    }
    return true;
}

/// The numbers in a file name, by which newer files are found: libdrd.so.3.17.6, sdk-3.17.6.
std::vector<std::uint64_t> numbers_in(const std::string& name) {
    std::vector<std::uint64_t> numbers;
    bool inside = false;
    for (const char letter : name) {
        const bool digit = letter >= '0' && letter <= '9';
        if (digit && !inside) numbers.push_back(0);
        if (digit) numbers.back() = 10 * numbers.back() + static_cast<std::uint64_t>(letter - '0');
        inside = digit;
    }
    return numbers;
}

/// What is in the folder of which the name begins so, newest first.
std::vector<fs::path> newest_first(const fs::path& folder, const std::string& begin) {
    std::vector<fs::path> found;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
        if (entry.path().filename().string().starts_with(begin)) found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end(), [](const fs::path& a, const fs::path& b) {
        return numbers_in(a.filename()) > numbers_in(b.filename());
    });
    return found;
}

std::optional<fs::path> library_in(const fs::path& folder, const std::string& name) {
    std::error_code ignored;
    if (fs::exists(folder / name, ignored)) return folder / name;
    const std::vector<fs::path> longer = newest_first(folder, name + ".");
    if (longer.empty()) return std::nullopt;
    return longer.front();
}

void add_libraries(const MakersLibrarySearch& search, const fs::path& folder,
                   std::vector<fs::path>& files) {
    for (const std::string& name : search.names) {
        if (auto file = library_in(folder, name)) files.push_back(*std::move(file));
        for (const std::string& sub_folder : search.sub_folders) {
            if (auto file = library_in(folder / sub_folder, name))
                files.push_back(*std::move(file));
        }
    }
}

std::vector<fs::path> usual_folders(const MakersLibrarySearch& search) {
    std::vector<fs::path> all;
    for (std::string folder : search.folders) {
        if (folder.starts_with("~/")) folder.replace(0, 1, home_folder().string());
        if (!folder.ends_with('*')) {
            all.emplace_back(folder);
            continue;
        }
        folder.pop_back();
        const fs::path begin(folder);
        for (fs::path& found : newest_first(begin.parent_path(), begin.filename()))
            all.push_back(std::move(found));
    }
    return all;
}

/// The loader's text is "FILE: why"; FILE is the library itself, or one that it needs.
std::string loader_refusal(const MakersLibrarySearch& search, const fs::path& file,
                           const std::string& why) {
    for (const auto& [library, package] : search.packages) {
        if (why.starts_with(library))
            return file.string() + " needs " + library + ", which is not installed: install " +
                   package;
    }
    return file.string() + " cannot be loaded (" + why + "): install it, and what it needs, again";
}

/// Loads `file`, a path or a name for the loader, and asks `why_not`.
MakersLibrary load(const MakersLibrarySearch& search, const fs::path& file,
                   const std::function<std::string(const MakersLibrary&)>& why_not) {
    const bool by_name = !file.has_parent_path();
    MakersLibrary library{.file = file};
    if (!by_name) library.trouble = why_no_library(file);
    if (!library.trouble.empty()) return library;
    std::string why;
    library.handle = load_library(file.string(), Resolve::now, why);
    if (library.handle == nullptr) {
        const bool absent =
            by_name && why.starts_with(file.string() + ": cannot open shared object file: No such");
        if (!absent) library.trouble = loader_refusal(search, file, why);
        return library;
    }
    library.trouble = why_not(library);
    if (!library.trouble.empty()) library.handle = nullptr;
    return library;
}

std::vector<fs::path> chosen_files(const MakersLibrarySearch& search) {
    std::vector<fs::path> files;
    std::error_code ignored;
    if (!fs::is_directory(search.chosen, ignored)) return {fs::absolute(search.chosen, ignored)};
    add_libraries(search, search.chosen, files);
    return files;
}

std::vector<fs::path> all_files(const MakersLibrarySearch& search) {
    std::vector<fs::path> files;
    for (const char* const name : search.variables) {
        const std::string_view folder = environment_variable(name);
        if (!folder.empty()) add_libraries(search, folder, files);
    }
    for (const std::string& name : search.names) files.emplace_back(name);
    for (const fs::path& folder : usual_folders(search)) add_libraries(search, folder, files);
    return files;
}

}  // namespace

std::string why_no_library(const fs::path& file) {
    const std::string name = file.string();
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        return errno == ENOENT
                   ? name + " does not exist: choose the maker's library"
                   : name + " cannot be read: allow it, with sudo chmod a+rx " + shell_word(name);
    }
    std::error_code ignored;
    const std::uintmax_t size = fs::file_size(file, ignored);
    const auto head = read_part<Elf64_Ehdr>(stream, 0);
    if (ignored || !head || std::memcmp(head->e_ident, ELFMAG, SELFMAG) != 0)
        return name + " is not a library, or is damaged: install the maker's library again";
    if (head->e_ident[EI_CLASS] == ELFCLASS32)
        return name +
               " is a 32-bit library, and dibhr is a 64-bit program: install the maker's "
               "64-bit library";
    if (head->e_machine != kOwnMachine || head->e_ident[EI_DATA] != ELFDATA2LSB)
        return name + " is for another processor: install the maker's library for " +
               kOwnMachineName;
    if (head->e_type != ET_DYN || !is_whole(stream, *head, size))
        return name + " is damaged: install the maker's library again";
    return {};
}

MakersLibrary load_makers_library(const MakersLibrarySearch& search,
                                  const std::function<std::string(const MakersLibrary&)>& why_not) {
    const bool is_chosen = !search.chosen.empty();
    MakersLibrary first_refused;
    for (const fs::path& file : is_chosen ? chosen_files(search) : all_files(search)) {
        MakersLibrary library = load(search, file, why_not);
        if (library.handle != nullptr) return library;
        if (first_refused.trouble.empty()) first_refused = std::move(library);
    }
    if (is_chosen && first_refused.trouble.empty())
        first_refused.trouble =
            search.chosen + " has no " + search.names.front() + ": choose the maker's library";
    return first_refused;
}

void* LibrarySymbols::address(const char* name) const noexcept {
    return handle_ != nullptr ? dlsym(handle_, name) : nullptr;
}

}  // namespace dibhr
