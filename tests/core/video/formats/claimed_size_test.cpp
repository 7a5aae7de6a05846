// The sizes that headers claim, as OpenCV writes them and as liars do.
#include "core/video/formats/file_bytes.hpp"

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "core/video/formats/still_picture.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

std::string encoded(const std::string& ending, int type) {
    std::vector<std::uint8_t> bytes;
    REQUIRE(cv::imencode(ending, cv::Mat(23, 37, type, cv::Scalar(7)), bytes));
    return {bytes.begin(), bytes.end()};
}

void check_claim(const std::string& bytes, std::int64_t columns, std::int64_t rows) {
    std::istringstream in(bytes);
    const auto claimed = claimed_size(in);
    REQUIRE(claimed);
    CHECK(claimed->columns == columns);
    CHECK(claimed->rows == rows);
}

std::string big_endian(std::uint32_t number) {
    std::string bytes;
    append_bytes(bytes, number, false);
    return bytes;
}

}  // namespace

TEST_CASE("a picture's header says its size before it is decoded", "[claimed]") {
    for (const std::string ending : {".png", ".bmp", ".pgm", ".pbm", ".pam", ".tiff", ".jpg"}) {
        CAPTURE(ending);
        check_claim(encoded(ending, CV_8UC1), 37, 23);
    }
    for (const std::string ending : {".png", ".bmp", ".ppm", ".tiff", ".jpg"}) {
        CAPTURE(ending);
        check_claim(encoded(ending, CV_8UC3), 37, 23);
    }
    check_claim("P5 # a comment\n# and 3 more\n640\t480\n255\n", 640, 480);
    check_claim(tiff(37, 23, 32, 3, false, std::string(37 * 23 * 4, 'a')), 37, 23);
    std::string jpeg = encoded(".jpg", CV_8UC1);
    jpeg.insert(jpeg.find("\xff\xdb"), "\xb0\xff");  // between two segments
    check_claim(jpeg, 37, 23);
    check_claim({"BM            \x0c\0\0\0\x25\0\x17\0", 22}, 37, 23);
}

TEST_CASE("a header that says no size claims none, wherever it is cut off", "[claimed]") {
    for (const std::string ending : {".png", ".bmp", ".pgm", ".pam", ".tiff", ".jpg"}) {
        const std::string whole = encoded(ending, CV_8UC1);
        CAPTURE(ending);
        for (std::size_t bytes = 0; bytes < 12; ++bytes) {
            std::istringstream in(whole.substr(0, bytes));
            const auto claimed = claimed_size(in);
            CHECK((!claimed || ending == ".pgm"));  // "P5\n3" says something
        }
    }
    std::istringstream none("RIFF of another form");
    CHECK_FALSE(claimed_size(none));
}

TEST_CASE("a picture that is too short for what its header claims is refused before it is decoded",
          "[claimed]") {
    const TemporaryFolder folder;
    const std::uint32_t side = GENERATE(10000U, 30000U, 2000000000U);
    const std::string length = std::to_string(side);
    std::string png = encoded(".png", CV_8UC1);
    png.replace(16, 8, big_endian(side) + big_endian(side));
    std::string bmp = encoded(".bmp", CV_8UC3);
    std::string corner;
    append_bytes(corner, side);
    bmp.resize(54);  // its header
    bmp.replace(18, 8, corner + corner);
    for (const std::string& bytes : {png, bmp, "P5 " + length + " " + length + " 255\nabcd",
                                     "P7\nWIDTH " + length + "\nHEIGHT " + length + "\n"}) {
        const auto file = folder / "a.picture";
        write_text(file, bytes);
        const std::string said = refusal([&] { (void)read_still(file, PictureRole::depth); });
        CAPTURE(said);
        CHECK(contains(said, "a.picture' says that it is " + length + " x " + length));
    }
}
