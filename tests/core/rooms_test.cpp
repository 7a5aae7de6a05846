// The rooms' one-way arrows: which room may include which, and which room owns which library.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

namespace {

namespace fs = std::filesystem;

struct Include {
    std::string file;  ///< "core/video/playing/player.cpp", from the source root
    std::string path;  ///< what it includes, as written
    bool quoted{false};
};

/// A room and the prefixes of what it may include from this tree.
struct Room {
    std::string folder;
    std::vector<std::string> may_include;
};

// A folder inside another one comes before it.
const std::vector<Room> kRooms{
    {"core/haptics/", {"core/haptics/"}},
    {"core/realtime/", {"core/realtime/", "core/error.hpp"}},
    {"core/files/", {"core/files/", "core/error.hpp"}},
    {"core/av/", {"core/av/", "core/files/", "core/error.hpp"}},
    {"core/sqlite/", {"core/sqlite/", "core/files/"}},
    {"core/sound/", {"core/sound/", "core/haptics/", "core/realtime/"}},
    {"core/video/modules/", {"core/video/modules/", "core/files/"}},
    {"core/video/frames/", {"core/video/frames/", "core/haptics/"}},
    {"core/video/cleaning/",
     {"core/video/cleaning/", "core/video/frames/", "core/files/", "core/haptics/"}},
    {"core/video/motion/",
     {"core/video/motion/", "core/video/cleaning/", "core/video/frames/", "core/haptics/",
      "core/realtime/"}},
    {"core/video/depth/",
     {"core/video/depth/", "core/video/cleaning/", "core/video/frames/", "core/files/",
      "core/haptics/", "core/error.hpp"}},
    {"core/video/formats/",
     {"core/video/formats/", "core/video/cleaning/", "core/video/depth/", "core/video/frames/",
      "core/video/modules/", "core/av/", "core/files/", "core/realtime/", "core/sqlite/",
      "core/error.hpp"}},
    {"core/video/live/",
     {"core/video/live/", "core/video/cleaning/", "core/video/depth/", "core/video/formats/",
      "core/video/frames/", "core/video/modules/", "core/av/", "core/files/", "core/realtime/",
      "core/error.hpp"}},
    {"core/video/sources/layouts/",
     {"core/video/sources/layouts/", "core/video/sources/media_names.hpp",
      "core/video/sources/readers.hpp", "core/video/sources/sources.hpp", "core/video/depth/",
      "core/video/formats/", "core/files/", "core/error.hpp"}},
    {"core/video/sources/",
     {"core/video/sources/", "core/video/cleaning/", "core/video/depth/", "core/video/formats/",
      "core/video/frames/", "core/video/live/", "core/video/modules/", "core/files/",
      "core/haptics/", "core/error.hpp"}},
    {"core/video/guide/",
     {"core/video/guide/", "core/video/formats/", "core/video/sources/", "core/files/",
      "core/haptics/", "core/error.hpp"}},
    {"core/video/playing/",
     {"core/video/playing/", "core/video/cleaning/", "core/video/frames/", "core/video/live/",
      "core/video/motion/", "core/video/sources/", "core/files/", "core/haptics/", "core/realtime/",
      "core/error.hpp"}},
    {"core/clip/", {"core/clip/", "core/av/", "core/files/", "core/video/", "core/error.hpp"}},
    {"core/estimate/",
     {"core/estimate/", "core/av/", "core/files/", "core/video/", "core/error.hpp"}},
    {"core/surface_files/",
     {"core/surface_files/", "core/files/", "core/haptics/", "core/video/", "core/error.hpp"}},
    {"core/session/",
     {"core/session/", "core/files/", "core/haptics/", "core/realtime/", "core/sqlite/",
      "core/error.hpp"}},
    {"core/metrics/", {"core/metrics/", "core/haptics/"}},
    {"core/psychophysics/", {"core/psychophysics/"}},
    {"core/plot/", {"core/plot/", "core/files/", "core/haptics/", "core/video/", "core/error.hpp"}},
    {"core/loop/",
     {"core/loop/", "core/haptics/", "core/realtime/", "core/session/", "core/sound/",
      "core/video/", "core/error.hpp"}},
    {"core/replay/",
     {"core/replay/", "core/files/", "core/haptics/", "core/loop/", "core/metrics/",
      "core/session/", "core/sqlite/", "core/video/", "core/error.hpp"}},
    {"core/experiment/",
     {"core/experiment/", "core/files/", "core/haptics/", "core/metrics/", "core/plot/",
      "core/video/", "core/error.hpp"}},
    {"core/study/",
     {"core/study/", "core/files/", "core/haptics/", "core/psychophysics/", "core/sqlite/",
      "core/error.hpp"}},
    {"core/archive/",
     {"core/archive/", "core/files/", "core/session/", "core/sqlite/", "core/study/",
      "core/error.hpp"}},
    {"core/study_report/",
     {"core/study_report/", "core/files/", "core/haptics/", "core/metrics/", "core/plot/",
      "core/psychophysics/", "core/report/", "core/session/", "core/sqlite/", "core/study/",
      "core/error.hpp"}},
    {"core/report/",
     {"core/report/", "core/files/", "core/haptics/", "core/plot/", "core/session/", "core/video/",
      "core/error.hpp"}},
    {"core/", {}},
    {"device/hand/check/", {"device/hand/check/", "core/files/", "core/error.hpp"}},
    {"device/hand/", {"device/hand/", "core/haptics/", "core/error.hpp"}},
    {"device/falcon/check/",
     {"device/falcon/", "device/hand/", "core/files/", "core/haptics/", "core/error.hpp"}},
    {"device/inverse3/check/",
     {"device/inverse3/", "device/hand/", "core/files/", "core/haptics/", "core/error.hpp"}},
    {"device/inverse3/simulated/",
     {"device/inverse3/simulated/", "core/files/", "core/haptics/", "core/error.hpp"}},
    {"device/", {"device/", "core/"}},
    {"render/", {"render/", "core/"}},
    {"assets/", {"assets/", "core/"}},
    {"app/settings/", {"app/settings/", "render/", "device/", "core/"}},
    {"app/desktop/", {"app/desktop/", "core/"}},
    {"app/window/", {"app/window/", "app/settings/", "core/"}},
    {"app/sound/", {"app/sound/", "core/"}},
    {"app/touching/",
     {"app/touching/", "app/settings/", "app/sound/", "app/window/", "render/", "device/",
      "core/"}},
    {"app/panels/",
     {"app/panels/", "app/touching/", "app/settings/", "app/sound/", "app/window/", "render/",
      "device/", "core/"}},
    {"app/viewer/",
     {"app/viewer/", "app/desktop/", "app/panels/", "app/touching/", "app/settings/", "app/sound/",
      "app/window/", "render/", "device/", "core/"}},
    {"app/study/",
     {"app/study/", "app/panels/", "app/touching/", "app/settings/", "app/window/", "render/",
      "device/", "core/"}},
    {"app/commands/",
     {"app/commands/", "app/desktop/", "app/study/", "app/viewer/", "app/panels/", "app/settings/",
      "app/window/", "device/", "core/"}},
    {"app/python/",
     {"app/python/", "core/files/", "core/haptics/", "core/session/", "core/sqlite/",
      "core/error.hpp"}},
    {"app/", {"app/", "core/"}},
};

/// Any other folder of device/ is that of a device, and may include itself and these.
const std::vector<std::string> kOfDevice{"device/hand/",
                                         "device/arm_buffers.hpp",
                                         "device/arm_check.hpp",
                                         "device/arm_device.hpp",
                                         "device/arm_exchanges.hpp",
                                         "device/call_record.hpp",
                                         "device/force_device.hpp",
                                         "device/grip_device.hpp",
                                         "device/library_thread.hpp",
                                         "device/makers_library.hpp",
                                         "device/recorded_device.hpp",
                                         "core/files/",
                                         "core/haptics/",
                                         "core/loop/",
                                         "core/realtime/",
                                         "core/error.hpp"};

/// A library only some rooms may include.
struct Ownership {
    std::string prefix;
    std::vector<std::string> rooms;
};

const std::vector<Ownership> kOwnerships{
    {"epoxy/", {"render/"}},
    {"GL/", {"render/"}},
    {"libusb", {"device/"}},
    {"simdjson", {"device/inverse3/message"}},
    {"boost/", {"core/psychophysics/", "device/inverse3/service_link"}},
    {"libav",
     {"core/av/", "core/clip/", "core/estimate/depth_video", "core/files/content_hash",
      "core/files/plain_text", "core/video/"}},
    {"libswscale/", {"core/av/", "core/clip/picture_encoder", "core/video/"}},
    {"sqlite3", {"core/sqlite/"}},
    {"imgui", {"app/window/", "app/panels/", "app/study/", "app/viewer/"}},
    {"SDL", {"app/sound/"}},
    {"systemd/", {"app/desktop/"}},
    {"alsa/", {"app/sound/"}},
    {"X11/", {"app/window/"}},
    {"GLFW/", {"app/window/", "app/settings/keys.cpp"}},
    {"CLI/", {"app/settings/", "app/commands/"}},
    {"toml",
     {"app/settings/", "core/study/protocol", "core/study/toml_page",
      "core/video/guide/regions_file", "core/video/sources/sidecar",
      "core/video/sources/touch_map_files"}},
    {"pybind11/", {"app/python/"}},
    {"opencv2/", {"core/estimate/", "core/video/", "assets/"}},
    {"png.h", {"core/surface_files/", "core/video/formats/"}},
    {"Imf", {"core/video/formats/"}},
    {"libheif/", {"core/video/formats/"}},
    {"zip.h", {"core/video/formats/"}},
    {"tiffio.h", {"core/video/modules/"}},
    {"expat.h", {"core/video/formats/xmp.cpp"}},
    {"zstd.h", {"core/files/float_code", "core/video/formats/"}},
    {"lz4frame.h", {"core/video/formats/"}},
    {"cairo", {"core/plot/"}},
    {"pango/", {"core/plot/"}},
};

// No file, clock, thread, log or picture library: numbers in, numbers out.
const std::vector<std::string> kNotInHaptics{"opencv2/", "chrono",   "thread",     "mutex",
                                             "fstream",  "iostream", "filesystem", "ctime"};

bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
    return std::any_of(prefixes.begin(), prefixes.end(),
                       [&](const std::string& prefix) { return text.starts_with(prefix); });
}

/// The first of kRooms that holds the file, or the room of its device; nothing: no room.
std::optional<Room> room_of(const std::string& file) {
    const auto room = std::find_if(kRooms.begin(), kRooms.end(), [&](const Room& candidate) {
        return file.starts_with(candidate.folder);
    });
    if (room == kRooms.end()) return std::nullopt;
    const auto end_of_name = file.find('/', room->folder.size());
    if (room->folder != "device/" || end_of_name == std::string::npos) return *room;
    Room device{file.substr(0, end_of_name + 1), kOfDevice};
    device.may_include.push_back(device.folder);
    return device;
}

std::vector<Include> includes_of(const fs::path& path, const std::string& name) {
    constexpr std::string_view kDirective = "#include";
    std::vector<Include> includes;
    std::ifstream stream(path);
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with(kDirective)) continue;
        const auto begin = line.find_first_of("<\"", kDirective.size());
        const auto end = line.find_first_of(">\"", begin + 1);
        if (begin == std::string::npos || end == std::string::npos) continue;
        includes.push_back({name, line.substr(begin + 1, end - begin - 1), line[begin] == '"'});
    }
    return includes;
}

/// Every include of every C++ file of the rooms.
std::vector<Include> all_includes() {
    const fs::path root = DIBHR_SOURCE_DIR;
    std::vector<Include> all;
    for (const char* folder : {"core", "device", "render", "assets", "app"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const auto ending = entry.path().extension();
            if (ending != ".hpp" && ending != ".cpp") continue;
            const auto name = entry.path().lexically_relative(root).generic_string();
            const auto includes = includes_of(entry.path(), name);
            all.insert(all.end(), includes.begin(), includes.end());
        }
    }
    return all;
}

std::string as_text(const Include& include) {
    return include.file + " includes " + include.path;
}

/// The includes for which `forbidden` holds, as text: empty is as it should be.
template <typename Forbidden>
std::vector<std::string> offences(Forbidden forbidden) {
    std::vector<std::string> found;
    for (const Include& include : all_includes()) {
        if (forbidden(include)) found.push_back(as_text(include));
    }
    return found;
}

// A name without a folder is a room's own generated header.
bool breaks_arrow(const Include& include) {
    const std::optional<Room> room = room_of(include.file);
    const bool names_a_folder = include.path.find('/') != std::string::npos;
    return include.quoted && names_a_folder &&
           (!room || !starts_with_any(include.path, room->may_include));
}

bool breaks_ownership(const Include& include) {
    return std::any_of(kOwnerships.begin(), kOwnerships.end(), [&](const Ownership& ownership) {
        return include.path.starts_with(ownership.prefix) &&
               !starts_with_any(include.file, ownership.rooms);
    });
}

bool breaks_numbers_only(const Include& include) {
    return include.file.starts_with("core/haptics/") &&
           starts_with_any(include.path, kNotInHaptics);
}

const std::vector<std::string> kNone{};

}  // namespace

TEST_CASE("a room includes only the rooms its arrows point to", "[rooms]") {
    REQUIRE(all_includes().size() > 100);
    CHECK(offences(breaks_arrow) == kNone);
}

TEST_CASE("only render calls OpenGL, device the USB, app the window and its panels", "[rooms]") {
    CHECK(offences(breaks_ownership) == kNone);
}

TEST_CASE("the haptic core knows no file, clock, thread or picture library", "[rooms]") {
    CHECK(offences(breaks_numbers_only) == kNone);
}

TEST_CASE("a device with its maker's library is named by no file outside its folder but the lists",
          "[rooms]") {
    const fs::path root = DIBHR_SOURCE_DIR;
    using Files = std::set<std::string>;
    for (const auto& [name, listed_in] : std::map<std::string, Files>{
             {"forcedimension", {"assets/CMakeLists.txt", "device/CMakeLists.txt"}},
             {"openhaptics", {"device/CMakeLists.txt"}}}) {
        Files named_in;
        for (const char* folder : {"core", "device", "render", "assets", "app"}) {
            for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
                const auto ending = entry.path().extension();
                const std::string file = entry.path().lexically_relative(root).generic_string();
                if (ending != ".hpp" && ending != ".cpp" && ending != ".txt") continue;
                if (file.starts_with("device/" + name + "/")) continue;
                if (dibhr::test::read_text(entry.path()).find(name) != std::string::npos)
                    named_in.insert(file);
            }
        }
        CHECK(named_in == listed_in);
    }
}

TEST_CASE("no folder holds more files than one can take in", "[rooms]") {
    const fs::path root = DIBHR_SOURCE_DIR;
    std::map<std::string, int> files;
    for (const char* folder : {"core", "device", "render", "app"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const auto ending = entry.path().extension();
            if (ending != ".hpp" && ending != ".cpp") continue;
            ++files[entry.path().parent_path().lexically_relative(root).generic_string()];
        }
    }
    REQUIRE(files.size() > 10);
    for (const auto& [folder, count] : files) {
        CAPTURE(folder, count);
        CHECK(count <= 45);
    }
}

TEST_CASE("the checks of the arrows find what they are there to find", "[rooms]") {
    CHECK(breaks_arrow({"core/haptics/proxy.cpp", "core/error.hpp", true}));
    CHECK(breaks_arrow({"core/video/playing/player.cpp", "render/camera.hpp", true}));
    CHECK(breaks_arrow({"core/video/any.cpp", "core/video/sources/media.hpp", true}));
    CHECK(
        breaks_arrow({"core/video/sources/layouts/any.cpp", "core/video/sources/media.hpp", true}));
    CHECK(breaks_arrow({"core/video/formats/exr.cpp", "core/video/sources/any.hpp", true}));
    CHECK(breaks_arrow({"core/video/depth/camera.cpp", "core/video/formats/any.hpp", true}));
    CHECK(breaks_arrow({"core/video/live/live_feed.cpp", "core/video/playing/player.hpp", true}));
    CHECK(breaks_arrow({"device/falcon.cpp", "app/settings/settings.hpp", true}));
    CHECK(breaks_arrow({"core/error.hpp", "core/haptics/vec.hpp", true}));
    CHECK(breaks_arrow({"app/main.cpp", "tests/support/catch.hpp", true}));
    CHECK(breaks_arrow({"core/video/playing/player.cpp", "../../render/camera.hpp", true}));
    CHECK(breaks_arrow({"core/experiment/sweep.cpp", "core/report/session_report.hpp", true}));
    CHECK(breaks_arrow({"core/report/report_page.cpp", "core/experiment/experiment.hpp", true}));
    CHECK(breaks_arrow({"app/panels/touch.cpp", "app/viewer/viewer.hpp", true}));
    CHECK(breaks_arrow({"app/touching/force_law.cpp", "app/panels/panels.hpp", true}));
    CHECK(breaks_arrow({"app/study/study_surface.cpp", "app/viewer/viewer.hpp", true}));
    CHECK(breaks_arrow({"app/python/session.cpp", "app/settings/settings.hpp", true}));
    CHECK(breaks_arrow({"device/falcon/link.cpp", "device/mouse_hand.hpp", true}));
    CHECK(breaks_arrow({"device/another/kind.cpp", "device/falcon/settings.hpp", true}));
    CHECK_FALSE(breaks_arrow({"device/another/kind.cpp", "device/another/settings.hpp", true}));
    CHECK_FALSE(breaks_arrow({"app/main.cpp", "core/error.hpp", true}));
    CHECK_FALSE(breaks_arrow({"core/video/sources/media.cpp", "core/video/live/x.hpp", true}));
    CHECK_FALSE(breaks_arrow({"render/relief_pass.cpp", "shader_sources.hpp", true}));
    CHECK(breaks_ownership({"app/window/window.cpp", "epoxy/gl.h", false}));
    CHECK(breaks_ownership({"render/relief.cpp", "GLFW/glfw3.h", false}));
    CHECK(breaks_numbers_only({"core/haptics/dibhr.cpp", "chrono", false}));
    CHECK_FALSE(breaks_numbers_only({"core/realtime/tick_timer.hpp", "chrono", false}));
}
