// A user's firmware file is checked before it is sent, and kept.
#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "device/falcon/firmware_image.hpp"
#include "tests/device/falcon/synthetic_firmware.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/environment_variable.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

namespace {

namespace fs = std::filesystem;
using dibhr::InputError;
using namespace dibhr::falcon;
using namespace dibhr::test;
using Bytes = std::vector<std::uint8_t>;

/// A folder that holds the user's data, too.
class Folder : public TemporaryFolder {
  public:
    [[nodiscard]] fs::path holding(std::string_view content,
                                   const char* name = "firmware.bin") const {
        std::ofstream(*this / name, std::ios::binary) << content;
        return *this / name;
    }
    [[nodiscard]] fs::path holding(const Bytes& content) const {
        return holding({reinterpret_cast<const char*>(content.data()), content.size()});
    }

  private:
    EnvironmentVariable data_home_{"XDG_DATA_HOME", (*this / "data").c_str()};
};

/// The message when the file is refused; empty: it is accepted.
std::string refusal_of(const fs::path& file) {
    try {
        (void)read_firmware(file);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

/// The image as libnifalcon's installed headers hold theirs.
std::string as_header(const Bytes& image) {
    std::ostringstream text;
    text << "#ifndef FIRMWARE_H\n#define FIRMWARE_H\nnamespace firmware\n{\n\tconst long SIZE = "
         << image.size() << ";\n\tuint8_t IMAGE[] = {" << std::hex;
    for (std::size_t k = 0; k < image.size(); ++k) {
        text << (k % 16 == 0 ? "\n\t\t" : " ") << "0x" << static_cast<unsigned>(image[k]) << ',';
    }
    text << "\n\t};\n};\n#endif\n";
    return text.str();
}

}  // namespace

TEST_CASE("a firmware file is read with its bytes, its hash and a name", "[firmware]") {
    const Folder folder;
    const Bytes bytes = synthetic_firmware();
    const FirmwareImage image = read_firmware(folder.holding(bytes));
    CHECK(image.bytes == bytes);
    CHECK(image.sha256.size() == 64);
    CHECK(image.name == "an image this program has not seen before");
    CHECK_FALSE(image.empty());
}

TEST_CASE("the four known images are recognised by the first half of their hash", "[firmware]") {
    const std::string rest(48, '0');
    CHECK(contains(name_of_firmware("1119e39c39fab1f3" + rest), "nvent_firmware.bin"));
    CHECK(contains(name_of_firmware("b2700d5cd5ca217e" + rest), "test_firmware.bin"));
    CHECK(contains(name_of_firmware("ae838730af34b582" + rest), "novint_T0.bin"));
    CHECK(contains(name_of_firmware("e0ae3598670fa1c8" + rest), "novint_T2.bin"));
    CHECK(contains(name_of_firmware("e0ae3598670fa1c9" + rest), "not seen before"));
}

TEST_CASE("an image with the blocks of a known one but other content is refused as damaged",
          "[firmware]") {
    struct Known {
        std::string file;
        std::vector<SyntheticBlock> blocks;
    };
    const auto known = GENERATE(
        Known{"nvent_firmware.bin",
              {{3643, 0x3F8002}, {241, 0x3F8E3D}, {336, 0x0093A2}, {2, 0x3F8000}}},
        Known{"test_firmware.bin",
              {{3210, 0x3F8002}, {128, 0x3F8C8C}, {264, 0x0002A6}, {2, 0x3F8000}, {31, 0x3F8D0C}}},
        Known{"novint_T0.bin",
              {{3448, 0x3F8002}, {183, 0x3F8D7A}, {266, 0x0002A6}, {2, 0x3F8000}, {31, 0x3F8E31}}});
    CAPTURE(known.file);
    const Folder folder;
    auto blocks = known.blocks;
    const auto refusal = [&] { return refusal_of(folder.holding(synthetic_firmware(blocks))); };
    SECTION("the very same blocks") {
        CHECK(contains(refusal(), "laid out like " + known.file +
                                      ", but its content differs: the file is damaged; take"));
        const std::string header = as_header(synthetic_firmware(blocks));
        CHECK(contains(refusal_of(folder.holding(header)), "the file is damaged"));
    }
    SECTION("one at another address is another image") {
        blocks.back().address += 0x40;
        CHECK(refusal().empty());
    }
    SECTION("one longer is another image") {
        blocks.back().words += 1;
        CHECK(refusal().empty());
    }
    SECTION("one less is another image") {
        blocks.pop_back();
        CHECK(refusal().empty());
    }
    SECTION("one more is another image") {
        blocks.push_back({2, 0x3F9000});
        CHECK(refusal().empty());
    }
}

TEST_CASE("the header of an installed libnifalcon serves as well", "[firmware]") {
    const Folder folder;
    const Bytes bytes = synthetic_firmware();
    const std::string header = as_header(bytes);
    CHECK(read_firmware(folder.holding(header)).bytes == bytes);
    SECTION("but not when it is cut off") {
        const std::string cut = header.substr(0, header.size() / 2);
        CHECK(contains(refusal_of(folder.holding(cut)), "text that holds no whole array"));
    }
    SECTION("nor when its numbers are no bytes") {
        CHECK(contains(refusal_of(folder.holding("int a[] = {0xAA, 0x8, 300};")),
                       "text that holds no whole array"));
        CHECK(contains(refusal_of(folder.holding("const char* a[] = {\"firmware\"};")),
                       "text that holds no whole array"));
    }
    SECTION("nor when its image is damaged") {
        Bytes damaged = bytes;
        damaged.resize(damaged.size() - 100);
        CHECK(contains(refusal_of(folder.holding(as_header(damaged))), "it ends"));
    }
}

TEST_CASE("a foreign file is refused as what it is", "[firmware]") {
    struct Foreign {
        std::string content;
        std::string what;
    };
    const Folder folder;
    const std::vector<Foreign> kinds{
        {"", "it is empty"},
        {std::string("\x89PNG\r\n\x1A\n\0\0\0\rIHDR", 16), "PNG picture"},
        {std::string("\x7F"
                     "ELF\2\1\1\0",
                     8),
         "Linux program"},
        {std::string("PK\3\4\0\0", 6), "ZIP archive"},
        {std::string("\x1F\x8B\x08\0", 4), "compressed archive"},
        {":10010000214601360121470136007EFE09D2190140\n:00000001FF\n", "Intel hex"},
        {"<!DOCTYPE html>\n<html><body>nvent_firmware.bin</body></html>\n", "web page"},
        {"just a note\n", "it is text"},
        {std::string("\xAA", 1), "AA 08"},
        {std::string("\x08\xAA\0\0\0\0", 6), "AA 08"},
        {std::string(8492, '\0'), "AA 08"},
        {std::string(8492, '\xFF'), "AA 08"}};
    for (const Foreign& foreign : kinds) {
        CAPTURE(foreign.what);
        const std::string refusal = refusal_of(folder.holding(foreign.content));
        CHECK(contains(refusal, foreign.what));
        CHECK(contains(refusal, "firmware.bin is no Falcon firmware: "));
    }
}

TEST_CASE("a refusal is one line: which file, why, and where people get one", "[firmware]") {
    const Folder folder;
    Bytes bytes = synthetic_firmware();
    bytes.resize(bytes.size() - 20);
    const fs::path file = folder.holding(bytes);
    const std::string refusal = refusal_of(file);
    CHECK(refusal == file.string() + " is no Falcon firmware: it ends inside block 2; " +
                         where_firmware_comes_from());
    CHECK(contains(where_firmware_comes_from(), "nvent_firmware.bin"));
    CHECK(contains(where_firmware_comes_from(), "libnifalcon"));
    CHECK(refusal.find('\n') == std::string::npos);
}

TEST_CASE("a path that is no readable file is refused", "[firmware]") {
    const Folder folder;
    CHECK(contains(refusal_of(folder.path()), "it is a folder"));
    CHECK(contains(refusal_of(folder / "missing.bin"), "there is no file"));
    CHECK(contains(refusal_of("/dev/zero"), "not an ordinary file"));
    CHECK_FALSE(refusal_of(folder.holding("x") / "inner.bin").empty());

    const fs::path pipe = folder / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(contains(refusal_of(pipe), "not an ordinary file"));

    // Nobody may read it; the superuser may read everything but this.
    const fs::path locked = folder.holding(synthetic_firmware());
    fs::permissions(locked, fs::perms::none);
    const fs::path unreadable = ::geteuid() == 0 ? fs::path("/proc/self/mem") : locked;
    CHECK(contains(refusal_of(unreadable), "make it readable"));
}

TEST_CASE("a huge file is refused by its size, unread", "[firmware]") {
    const Folder folder;
    const fs::path file = folder.holding("");
    fs::resize_file(file, std::uintmax_t{1} << 40U);  // nobody could read that
    CHECK(contains(refusal_of(file), "it has 1099511627776 bytes"));
    CHECK_FALSE(fault_of_firmware(Bytes(300000)).empty());
}

TEST_CASE("an accepted file is kept, and found again", "[firmware]") {
    const Folder folder;
    CHECK(kept_firmware().empty());
    const Bytes bytes = synthetic_firmware(500, 7);
    const FirmwareImage image = keep_firmware(folder.holding(bytes));
    CHECK(image.bytes == bytes);
    CHECK(kept_firmware_path() == folder / "data" / "dibhr" / "falcon-firmware.bin");
    CHECK(kept_firmware().bytes == bytes);
    CHECK(kept_firmware().sha256 == image.sha256);

    const Bytes other = synthetic_firmware(600, 8);
    (void)keep_firmware(folder.holding(other));
    CHECK(kept_firmware().bytes == other);
    CHECK(keep_firmware(kept_firmware_path()).bytes == other);
}

TEST_CASE("of a header only the bytes are kept", "[firmware]") {
    const Folder folder;
    const Bytes bytes = synthetic_firmware(50);
    (void)keep_firmware(folder.holding(as_header(bytes)));
    CHECK(fs::file_size(kept_firmware_path()) == bytes.size());
    CHECK(kept_firmware().bytes == bytes);
}

TEST_CASE("a refused file does not replace the kept one", "[firmware]") {
    const Folder folder;
    const Bytes bytes = synthetic_firmware();
    (void)keep_firmware(folder.holding(bytes));
    CHECK_THROWS_AS(keep_firmware(folder.holding("no firmware")), InputError);
    CHECK(kept_firmware().bytes == bytes);
}

TEST_CASE("a kept file that was damaged is refused by its name", "[firmware]") {
    const Folder folder;
    (void)keep_firmware(folder.holding(synthetic_firmware()));
    fs::resize_file(kept_firmware_path(), 1000);
    try {
        (void)kept_firmware();
        FAIL("a damaged image was taken");
    } catch (const InputError& error) {
        CHECK(contains(error.what(), kept_firmware_path().string()));
        CHECK(contains(error.what(), "it ends inside block 1"));
    }
}

TEST_CASE("a folder that cannot be made is told", "[firmware]") {
    const Folder folder;
    const fs::path file = folder.holding(synthetic_firmware());
    (void)folder.holding("a file where the folder should be", "data");
    try {
        (void)keep_firmware(file);
        FAIL("kept nowhere");
    } catch (const InputError& error) {
        CHECK(contains(error.what(), "cannot make the folder"));
    }
}

TEST_CASE("without XDG_DATA_HOME, or with a relative one, the home folder keeps the image",
          "[firmware]") {
    const Folder folder;
    const char* home = std::getenv("HOME");
    const fs::path expected = fs::path(home != nullptr ? home : "/") / ".local" / "share" /
                              "dibhr" / "falcon-firmware.bin";
    ::unsetenv("XDG_DATA_HOME");
    CHECK(kept_firmware_path() == expected);
    ::setenv("XDG_DATA_HOME", "relative/path", 1);
    CHECK(kept_firmware_path() == expected);
}
