// The structure of a firmware image is checked to its last bit (device/falcon/README.md, Firmware
// images).
#include "device/falcon/firmware_image.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tests/device/falcon/synthetic_firmware.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

namespace {

using dibhr::test::contains;
using dibhr::test::synthetic_firmware;
using namespace dibhr::falcon;
using Bytes = std::vector<std::uint8_t>;

// Where the parts of the synthetic image begin [bytes].
constexpr std::size_t kReservedAt = 2;
constexpr std::size_t kEntryAt = 18;
constexpr std::size_t kFirstBlockAt = 22;
constexpr std::size_t kBlockHeaderBytes = 6;

void set_word(Bytes& image, std::size_t at, unsigned word) {
    image[at] = static_cast<std::uint8_t>(word & 0xFFU);
    image[at + 1] = static_cast<std::uint8_t>(word >> 8U);
}

}  // namespace

TEST_CASE("an image in the container format is accepted, whatever its blocks hold", "[firmware]") {
    const std::size_t words = GENERATE(4U, 100U, 3600U, 30000U);
    const std::uint32_t seed = GENERATE(1U, 2U, 3U);
    CHECK(fault_of_firmware(synthetic_firmware(words, seed)).empty());
}

TEST_CASE("an image cut off anywhere is refused for its end", "[firmware]") {
    const Bytes image = synthetic_firmware(60);
    for (std::size_t length = 2; length < image.size(); ++length) {
        CAPTURE(length);
        const std::string fault = fault_of_firmware(std::span(image).first(length));
        CHECK(contains(fault, "it ends"));
    }
    CHECK(contains(fault_of_firmware(std::span(image).first(1)), "AA 08"));
    CHECK(contains(fault_of_firmware({}), "empty"));
}

TEST_CASE("the place where an image ends too early is named", "[firmware]") {
    const Bytes image = synthetic_firmware(60);  // blocks of 54, 4 and 2 words
    const auto fault_of_first = [&](std::size_t length) {
        return fault_of_firmware(std::span(image).first(length));
    };
    const std::size_t second = kFirstBlockAt + kBlockHeaderBytes + 2 * std::size_t{54};
    CHECK(fault_of_first(10) == "it ends inside its header");
    CHECK(fault_of_first(kFirstBlockAt) == "it ends before block 1 or the zero that closes it");
    CHECK(fault_of_first(kFirstBlockAt + 4) == "it ends inside the header of block 1");
    CHECK(fault_of_first(second - 1) == "it ends inside block 1");
    CHECK(fault_of_first(second) == "it ends before block 2 or the zero that closes it");
    CHECK(fault_of_first(image.size() - 1) == "it ends before block 4 or the zero that closes it");
}

TEST_CASE("bytes after the closing zero are refused", "[firmware]") {
    const std::size_t more = GENERATE(1U, 2U, 3U, 1000U);
    Bytes image = synthetic_firmware(60);
    image.resize(image.size() + more);
    CHECK(fault_of_firmware(image) ==
          std::to_string(more) + " bytes follow the zero that closes it");
}

TEST_CASE("a damaged bit in key, reserved words or the lengths of blocks is refused",
          "[firmware]") {
    const Bytes image = synthetic_firmware(60);
    const std::size_t second = kFirstBlockAt + kBlockHeaderBytes + 2 * std::size_t{54};
    const std::size_t third = second + kBlockHeaderBytes + 2 * std::size_t{4};
    std::vector<std::size_t> places;
    for (std::size_t at = 0; at < kEntryAt; ++at) places.push_back(at);
    for (const std::size_t block : {kFirstBlockAt, second, third, image.size() - 2}) {
        places.push_back(block);
        places.push_back(block + 1);
    }
    for (const std::size_t at : places) {
        for (unsigned bit = 0; bit < 8; ++bit) {
            CAPTURE(at, bit);
            Bytes damaged = image;
            damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ (1U << bit));
            CHECK_FALSE(fault_of_firmware(damaged).empty());
        }
    }
}

TEST_CASE("the damaged field of the header is named", "[firmware]") {
    Bytes image = synthetic_firmware(60);
    SECTION("key") {
        set_word(image, 0, 0xAA08);
        CHECK(fault_of_firmware(image) == "it does not begin with AA 08");
    }
    SECTION("reserved word") {
        set_word(image, kReservedAt + 2 * 2, 1);
        CHECK(fault_of_firmware(image) == "reserved word 3 of its header is not 0");
    }
    SECTION("entry point beyond 22 bits") {
        set_word(image, kEntryAt, 0x40);
        CHECK(fault_of_firmware(image) ==
              "its entry point 408002 does not fit into 22 bits of address");
    }
    SECTION("entry point beside the blocks") {
        set_word(image, kEntryAt, 0x00);
        CHECK(fault_of_firmware(image) == "its entry point 008002 lies in none of its blocks");
    }
    SECTION("entry point just after the first block") {
        set_word(image, kEntryAt + 2, 0x8002 + 54);
        CHECK(contains(fault_of_firmware(image), "in none of its blocks"));
    }
    SECTION("address of a block beyond 22 bits") {
        set_word(image, kFirstBlockAt + 2, 0xFFFF);
        CHECK(fault_of_firmware(image) ==
              "block 1 at FFFF8002 does not fit into 22 bits of address");
    }
    SECTION("end of a block beyond 22 bits") {
        set_word(image, kFirstBlockAt + 4, 0xFFFF);
        CHECK(contains(fault_of_firmware(image), "block 1 at 3FFFFF does not fit"));
    }
    SECTION("no block at all") {
        image.resize(kFirstBlockAt + 2);
        set_word(image, kFirstBlockAt, 0);
        CHECK(contains(fault_of_firmware(image), "in none of its blocks"));
    }
}
