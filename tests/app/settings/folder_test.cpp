// What the Open dialog lists, and how it completes what is typed.
#include "app/settings/folder.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "app/viewer/files.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace dibhr;
using dibhr::test::TemporaryFolder;

namespace {

void put(const fs::path& file, int bytes = 3) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << std::string(static_cast<std::size_t>(bytes), 'x');
}

std::vector<std::string> names_of(const Folder& folder) {
    std::vector<std::string> names;
    for (const FolderEntry& entry : folder.entries) names.push_back(entry.name());
    return names;
}

}  // namespace

TEST_CASE("a folder lists folders first, then files, numbers by their value, nothing hidden",
          "[folder]") {
    const TemporaryFolder folder;
    for (const char* name :
         {"take10.mp4", "take9.mp4", "Notes.txt", ".hidden.mp4", "zoo/a.png", "Albums/b.png"}) {
        put(folder / name);
    }
    CHECK(names_of(read_folder(folder.path())) ==
          std::vector<std::string>{"Albums/", "zoo/", "Notes.txt", "take9.mp4", "take10.mp4"});
}

TEST_CASE("colour and depth of one recording are one row, wherever the words stand", "[folder]") {
    const TemporaryFolder folder;
    put(folder / "take2_color.mp4", 100);
    put(folder / "Take2-Depth.mp4", 30);
    put(folder / "take3_rgb.png");
    put(folder / "take3_depth.mkv");  // a video is no picture's depth
    put(folder / "lonely_depth.mp4");
    const Folder read = read_folder(folder.path());
    CHECK(names_of(read) == std::vector<std::string>{"lonely_depth.mp4",
                                                     "take2_color.mp4 + Take2-Depth.mp4",
                                                     "take3_depth.mkv", "take3_rgb.png"});
    const auto pair = index_of_entry(read, folder / "Take2-Depth.mp4");
    REQUIRE(pair);
    CHECK(read.entries[*pair].bytes == 130);
    CHECK(read.entries[*pair].file == folder / "take2_color.mp4");
    CHECK_FALSE(index_of_entry(read, folder / "gone.mp4"));
}

TEST_CASE("what the program opens is told from what it does not", "[folder]") {
    const TemporaryFolder folder;
    for (const char* name : {"a.dibhr", "b.MP4", "c.png", "d.txt", "e/f", "g.mcap"})
        put(folder / name);
    std::vector<FileKind> kinds;
    for (const FolderEntry& entry : read_folder(folder.path()).entries) {
        kinds.push_back(entry.kind);
        CHECK(can_be_opened(entry) == (entry.kind != FileKind::other));
    }
    CHECK(kinds == std::vector<FileKind>{FileKind::folder, FileKind::session, FileKind::video,
                                         FileKind::picture, FileKind::other, FileKind::video});
}

TEST_CASE("a file of every ending that opens is listed as one that can be opened", "[folder]") {
    const TemporaryFolder folder;
    const std::vector<std::string> endings = endings_that_open();
    for (const std::string& ending : endings) put(folder / ("take" + ending));
    const Folder read = read_folder(folder.path());
    CHECK(endings.size() > 20);
    CHECK(read.entries.size() == endings.size());
    CHECK(std::all_of(read.entries.begin(), read.entries.end(), can_be_opened));
}

TEST_CASE("a folder that cannot be read says so in a line, and names itself", "[folder]") {
    const TemporaryFolder folder;
    const Folder read = read_folder(folder / "gone");
    CHECK(read.entries.empty());
    CHECK(read.trouble.find("gone") != std::string::npos);
    CHECK(read.trouble.find("cannot be read") != std::string::npos);
}

TEST_CASE("Tab completes as far as there is one way to go on", "[folder]") {
    const TemporaryFolder folder;
    for (const char* name : {"recordings/one_color.mp4", "recordings/one_depth.mp4", "readme.txt"})
        put(folder / name);
    CHECK(completed("rec", folder.path()) == "recordings/");
    CHECK(completed("re", folder.path()) == "re");  // recordings, readme
    CHECK(completed("recordings/", folder.path()) == "recordings/one_");
    CHECK(completed("recordings/one_c", folder.path()) == "recordings/one_color.mp4");
    CHECK(completed("nothing", folder.path()) == "nothing");
    const std::string whole = folder.path().string();
    CHECK(completed(whole + "/readm", "/") == whole + "/readme.txt");
    CHECK(completed("gone/x", folder.path()) == "gone/x");
}

TEST_CASE("what is typed means a file that is there, from the folder on; else the chosen row",
          "[folder]") {
    const TemporaryFolder folder;
    for (const char* name : {"one_color.mp4", "one_depth.mp4", "below/two.mp4"}) put(folder / name);
    const Folder read = read_folder(folder.path());
    const FolderEntry chosen{FileKind::video, folder / "one_color.mp4"};
    CHECK(resolve_typed(read, "one_depth.mp4", {})->name() == "one_color.mp4 + one_depth.mp4");
    CHECK(resolve_typed(read, "below/two.mp4", chosen)->file == folder / "below/two.mp4");
    CHECK(resolve_typed(read, "below", {})->kind == FileKind::folder);
    CHECK(resolve_typed(read, (folder / "below").string(), {})->file == folder / "below");
    CHECK(resolve_typed(read, "one", chosen)->file == chosen.file);
    CHECK_FALSE(resolve_typed(read, "gone.mp4", {}));
}

TEST_CASE("a folder that holds no pictures itself is told apart from a file that is none",
          "[folder]") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "recordings/monday");
    write_text(folder / "recordings/notes.txt", "which jug?");
    OpenRequest request{folder / "recordings"};
    request.in_any_order = true;
    CHECK(try_open(request).is_folder);
    request.colour = folder / "recordings/notes.txt";
    CHECK_FALSE(try_open(request).is_folder);
    fs::create_directory(folder / "pictures");
    write_depth_png(folder / "pictures/depth_000.png", 8, 6, 100);
    request.colour = folder / "pictures";
    const OpenResult opened = try_open(request);
    CAPTURE(opened.failure);
    CHECK(opened.media);
    CHECK_FALSE(opened.is_folder);
}
