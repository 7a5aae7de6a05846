// What people open as a picture or a video, and the names that belong together: a picture of a size
// that can be touched, or one line.
#include <string>

#include "core/files/names.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/media_names.hpp"
#include "core/video/sources/picture_files.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/frames.hpp"

using namespace dibhr;

namespace {

void look_at_name(const std::filesystem::path& folder, const std::string& name) {
    const std::filesystem::path file = folder / name;
    test::require_one_line(shown(file));
    std::string looked_for;
    test::require_rule(!find_depth_beside(file, looked_for) && !find_colour_beside(file),
                       "in an empty folder nothing is found");
    if (!looked_for.empty()) test::require_one_line(looked_for);
    (void)named_depth(file);
}

/// A depth picture that colours go with.
const std::filesystem::path& other_picture() {
    static const test::InputFile file("depth.pgm");
    static const std::string bytes = "P5 2 2 255\nabcd";
    static const std::filesystem::path path =
        file.with({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    return path;
}

void look_into(const std::filesystem::path& file) {
    (void)test::is_taken([&file] { (void)describe_media(file); });
    (void)test::is_taken([&file] { (void)read_bump_map(file); });
    for (const bool find_out : {false, true}) {
        (void)test::is_taken(
            [&] { test::require_frames(open_depth(file, {.find_out = find_out})); });
    }
    for (const DepthCode code : kDepthCodes) {
        const DepthRequest told{.find_out = true, .command_line = {.code = code}};
        (void)test::is_taken([&] { test::require_frames(open_depth(file, told)); });
    }
    (void)test::is_taken([&file] {
        const auto frame = open_media(file, other_picture())->next();
        test::require_rule(frame && frame->colour.columns >= 2 && frame->colour.rows >= 2,
                           "colours have a size that can be shown");
    });
}

}  // namespace

/// "name:" and a name, or the file itself.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const test::InputFile file("input");
    static const test::TemporaryFolder nothing;
    const std::string text(data, data + size);
    constexpr std::string_view kName = "name:";
    if (text.starts_with(kName)) {
        const std::string name = text.substr(kName.size());
        look_at_name(nothing.path(), name.substr(0, name.find('\0')));  // as the system takes one
    } else {
        look_into(file.with({data, size}));
    }
    return 0;
}
