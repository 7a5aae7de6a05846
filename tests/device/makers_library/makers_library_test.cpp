// Finding, checking and loading a maker's library.
#include "device/makers_library.hpp"

#include <elf.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace dibhr;
using test::TemporaryFolder;
namespace fs = std::filesystem;

constexpr const char* kVariable = "DIBHR_TEST_SDK";

/// The variable, while this object lives.
class Variable {
  public:
    explicit Variable(const fs::path& folder) { setenv(kVariable, folder.c_str(), 1); }
    ~Variable() { unsetenv(kVariable); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;
};

MakersLibrarySearch search_for_sample() {
    MakersLibrarySearch search;
    search.names = {"libdibhr_sample.so.3"};
    search.variables = {kVariable};
    search.sub_folders = {"lib/release"};
    return search;
}

std::string usable(const MakersLibrary&) {
    return {};
}

void put(const fs::path& library, const fs::path& as) {
    fs::create_directories(as.parent_path());
    fs::copy_file(library, as);
}

/// A copy of the sample in which the byte at `offset` is another one.
fs::path changed_sample(const TemporaryFolder& folder, std::size_t offset, char value) {
    const fs::path file = folder / "changed.so";
    put(SAMPLE_LIBRARY, file);
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(offset));
    stream.put(value);
    return file;
}

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("nothing is said of a library that is not installed", "[makers_library]") {
    const MakersLibrary library = load_makers_library(search_for_sample(), usable);
    CHECK(library.handle == nullptr);
    CHECK(library.trouble.empty());
}

TEST_CASE("the environment names the folder of a library, which may lie deeper in it",
          "[makers_library]") {
    const TemporaryFolder folder;
    const Variable variable(folder.path());
    const std::string place = GENERATE(as<std::string>{}, "", "lib/release/");
    const std::string numbers = GENERATE(as<std::string>{}, "", ".17.6");
    const fs::path file = folder / (place + "libdibhr_sample.so.3" + numbers);
    put(SAMPLE_LIBRARY, file);
    const MakersLibrary library = load_makers_library(search_for_sample(), usable);
    REQUIRE(library.handle != nullptr);
    CHECK(library.file == file);
    int (*version)() = nullptr;
    LibrarySymbols symbols(library.handle);
    symbols.required(version, "sample_version");
    REQUIRE(version != nullptr);
    CHECK(version() == 7);
    CHECK(symbols.missing().empty());
}

TEST_CASE("of several versions in a folder, and of several folders, the newest is loaded",
          "[makers_library]") {
    const TemporaryFolder folder;
    for (const char* const sdk : {"sdk-3.9.1", "sdk-3.17.6", "sdk-3.17.10"})
        put(SAMPLE_LIBRARY, folder / sdk / "lib/release/libdibhr_sample.so.3.1");
    put(SAMPLE_LIBRARY, folder / "sdk-3.17.10/lib/release/libdibhr_sample.so.3.10");
    MakersLibrarySearch search = search_for_sample();
    search.folders = {(folder / "sdk-").string() + "*"};
    const MakersLibrary library = load_makers_library(search, usable);
    CHECK(library.file == folder / "sdk-3.17.10/lib/release/libdibhr_sample.so.3.10");
}

TEST_CASE("a chosen library is the only one that is tried", "[makers_library]") {
    const TemporaryFolder folder;
    const Variable variable(folder.path());
    put(SAMPLE_LIBRARY, folder / "libdibhr_sample.so.3");
    MakersLibrarySearch search = search_for_sample();
    search.chosen = (folder / "other").string();
    const MakersLibrary missing = load_makers_library(search, usable);
    CHECK(missing.handle == nullptr);
    CHECK(says(missing.trouble, search.chosen + " does not exist"));
    fs::create_directories(search.chosen);
    CHECK(says(load_makers_library(search, usable).trouble, "has no libdibhr_sample.so.3"));
    search.chosen = folder.path().string();
    CHECK(load_makers_library(search, usable).handle != nullptr);
}

TEST_CASE("a library of the system is found by its name", "[makers_library]") {
    MakersLibrarySearch search;
    search.names = {"libm.so.6"};
    CHECK(load_makers_library(search, usable).handle != nullptr);
}

TEST_CASE("a library that cannot be used is passed over for the next, and named if there is none",
          "[makers_library]") {
    const TemporaryFolder folder;
    const Variable variable(folder.path());
    put(SAMPLE_LIBRARY, folder / "libdibhr_sample.so.3");
    const auto only_usual = [&](const MakersLibrary& library) -> std::string {
        return says(library.file, "usual") ? "" : library.file.string() + " is too old";
    };
    MakersLibrarySearch search = search_for_sample();
    const MakersLibrary refused = load_makers_library(search, only_usual);
    CHECK(refused.handle == nullptr);
    CHECK(says(refused.trouble, "libdibhr_sample.so.3 is too old"));
    put(SAMPLE_LIBRARY, folder / "usual/libdibhr_sample.so.3");
    search.folders = {(folder / "usual").string()};
    CHECK(load_makers_library(search, only_usual).handle != nullptr);
}

TEST_CASE("a file that the loader cannot load is named with its fault before any code of it runs",
          "[makers_library]") {
    const TemporaryFolder folder;
    CHECK(why_no_library(SAMPLE_LIBRARY).empty());
    CHECK(says(why_no_library(folder / "none"), "does not exist"));
    CHECK(
        says(why_no_library(changed_sample(folder, EI_CLASS, ELFCLASS32)), "is a 32-bit library"));
    fs::remove(folder / "changed.so");
    constexpr char kSparc = 2;
    CHECK(says(why_no_library(changed_sample(folder, offsetof(Elf64_Ehdr, e_machine), kSparc)),
               "for another processor"));
    fs::remove(folder / "changed.so");
    CHECK(says(why_no_library(changed_sample(folder, 0, 'x')), "is not a library"));
    fs::remove(folder / "changed.so");
    CHECK(says(why_no_library(changed_sample(folder, offsetof(Elf64_Ehdr, e_type), ET_REL)),
               "is damaged"));
}

TEST_CASE("a library that was cut off anywhere is refused, and never read beyond its end",
          "[makers_library]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "cut.so";
    put(SAMPLE_LIBRARY, file);
    const auto whole = fs::file_size(file);
    const auto size = GENERATE_COPY(whole - 1, whole / 2, whole / 8, std::uintmax_t{100},
                                    std::uintmax_t{64}, std::uintmax_t{63}, std::uintmax_t{0});
    CAPTURE(size);
    fs::resize_file(file, size);
    MakersLibrarySearch search = search_for_sample();
    search.chosen = file.string();
    const std::string why_not = why_no_library(file);
    CHECK(says(why_not, "install the maker's library again"));
    CHECK(load_makers_library(search, usable).trouble == why_not);
}

TEST_CASE("a library that is needed and not installed is reported by the name of its package",
          "[makers_library]") {
    const TemporaryFolder folder;
    put(NEEDING_LIBRARY, folder / "libdibhr_sample.so.3");
    const Variable variable(folder.path());
    MakersLibrarySearch search = search_for_sample();
    CHECK(says(load_makers_library(search, usable).trouble, "cannot be loaded (libabsent_library"));
    search.packages = {{"libabsent_library.so", "libabsent1"}};
    CHECK(load_makers_library(search, usable).trouble ==
          (folder / "libdibhr_sample.so.3").string() +
              " needs libabsent_library.so, which is not installed: install libabsent1");
}

TEST_CASE("a function that a library does not have is named, or left out", "[makers_library]") {
    MakersLibrarySearch search = search_for_sample();
    search.chosen = SAMPLE_LIBRARY;
    LibrarySymbols symbols(load_makers_library(search, usable).handle);
    int (*version)() = nullptr;
    void (*other)(double) = nullptr;
    symbols.optional(other, "sample_stop");
    CHECK(other == nullptr);
    CHECK(symbols.missing().empty());
    symbols.required(other, "sample_stop");
    symbols.required(version, "sample_version");
    CHECK(version != nullptr);
    CHECK(symbols.missing() == "sample_stop");
}
