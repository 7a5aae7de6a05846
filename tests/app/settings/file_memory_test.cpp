// The memory of a file is read as it was saved, and nothing else is.
#include "app/settings/file_memory.hpp"

#include <fstream>

#include "core/video/sources/kept_choices.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace dibhr;
using dibhr::test::TemporaryFolder;

TEST_CASE("what is remembered of a file comes back to the same bits, and only of that file",
          "[memory]") {
    const TemporaryFolder folder;
    const fs::path media = folder / "take \"one\"\t.mp4";
    const FileMemory memory{1.0 / 3.0, "dibhr-view 0.1 0.2 1 0 0 0", 12.345678901234567};
    keep_memory(folder / "files", media, memory);
    CHECK(read_memory(folder / "files", media) == memory);
    CHECK(read_memory(folder / "files", folder / "other" / "take \"one\"\t.mp4") == FileMemory{});
    keep_memory(folder / "files", media, {});
    CHECK(read_memory(folder / "files", media) == FileMemory{});
    CHECK(fs::is_empty(folder / "files"));
}

TEST_CASE("a memory that cannot be understood is none", "[memory]") {
    const TemporaryFolder folder;
    const fs::path media = folder / "take.mp4";
    const fs::path file = kept_choice_of(folder.path(), media);
    for (const char* text :
         {"", "\xff\xfe", "relief = ", "relief = \"high\"\nat = -3\n",
          "relief = nan\nat = inf\nview = 7\n", "relief = 1e300\n", "[view]\n"}) {
        std::ofstream(file) << text;
        CHECK(read_memory(folder.path(), media) == FileMemory{});
    }
    fs::remove(file);
    fs::create_directories(file);
    CHECK(read_memory(folder.path(), media) == FileMemory{});
}
