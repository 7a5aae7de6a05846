// Photos of phones with a depth map inside: two pictures, or one line.
#include <opencv2/core.hpp>

#include "core/video/formats/libraries.hpp"
#include "core/video/formats/still_picture.hpp"
#include "tests/fuzz/entry.hpp"

using namespace dibhr;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const test::InputFile input("photo.jpg");
    set_up_libraries();
    const std::filesystem::path& file = input.with({data, size});
    (void)jpeg_has_depth(file);
    (void)test::is_taken([&file] {
        const cv::Mat depth = read_jpeg_photo(file, PictureRole::depth).picture;
        test::require_rule(!depth.empty() && depth.channels() == 1, "depth has one channel");
    });
    (void)test::is_taken([&file] {
        const cv::Mat colour = read_jpeg_photo(file, PictureRole::colour).picture;
        test::require_rule(colour.type() == CV_8UC3, "colour has 8 bits and three channels");
    });
    return 0;
}
