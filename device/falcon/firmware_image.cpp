// A firmware file of the user: its structure, its name, and where a copy is kept.
#include "device/falcon/firmware_image.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "core/files/machine.hpp"
#include "core/files/output_file.hpp"

namespace dibhr::falcon {
namespace fs = std::filesystem;

namespace {

using Bytes = std::span<const std::uint8_t>;

/// Our limit: the known images are below 9 KiB, below 64 KiB as C source.
constexpr std::size_t kMostBytes = std::size_t{256} * 1024;

constexpr std::uint32_t kKey = 0x08AA;
constexpr int kReservedWords = 8;
constexpr std::uint32_t kAddressEnd = 1U << 22U;

/// Words at an address.
struct Block {
    std::uint32_t words{0};
    std::uint32_t address{0};

    bool operator==(const Block&) const = default;
};

/// README.md, Firmware images; none has more than five blocks.
struct KnownImage {
    std::string_view sha256_begins;  ///< the first half
    std::string_view file;
    std::string_view origin;
    std::array<Block, 5> blocks;
};
constexpr std::array<KnownImage, 4> kKnownImages{{
    {"1119e39c39fab1f3",
     "nvent_firmware.bin",
     "Novint nVent",
     {{{3643, 0x3F8002}, {241, 0x3F8E3D}, {336, 0x0093A2}, {2, 0x3F8000}}}},
    {"b2700d5cd5ca217e",
     "test_firmware.bin",
     "NOVINT.BIN of Novint's driver disc",
     {{{3210, 0x3F8002}, {128, 0x3F8C8C}, {264, 0x0002A6}, {2, 0x3F8000}, {31, 0x3F8D0C}}}},
    {"ae838730af34b582",
     "novint_T0.bin",
     "Novint",
     {{{3448, 0x3F8002}, {183, 0x3F8D7A}, {266, 0x0002A6}, {2, 0x3F8000}, {31, 0x3F8E31}}}},
    {"e0ae3598670fa1c8",
     "novint_T2.bin",
     "Novint",
     {{{3448, 0x3F8002}, {183, 0x3F8D7A}, {266, 0x0002A6}, {2, 0x3F8000}, {31, 0x3F8E31}}}},
}};

/// Files that users take for the firmware by mistake: their first bytes, and what they are.
constexpr std::array<std::array<std::string_view, 2>, 8> kForeignStarts{{
    {"\x89PNG", "it is a PNG picture"},
    {"\xFF\xD8\xFF", "it is a JPEG picture"},
    {"\177ELF", "it is a Linux program or library"},
    {"MZ", "it is a Windows program"},
    {"PK", "it is a ZIP archive that has to be unpacked first"},
    {"\x1F\x8B", "it is a compressed archive that has to be unpacked first"},
    {":", "it is Intel hex text instead of the bytes themselves"},
    {"<", "it is a web page instead of the file that the page shows"},
}};

/// Null: not a known image.
const KnownImage* known_image(std::string_view sha256) {
    const auto found = std::find_if(
        kKnownImages.begin(), kKnownImages.end(),
        [&](const KnownImage& known) { return sha256.starts_with(known.sha256_begins); });
    return found == kKnownImages.end() ? nullptr : &*found;
}

bool is_text(Bytes bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) {
        return (byte >= 0x20 && byte < 0x7F) || byte == '\n' || byte == '\r' || byte == '\t';
    });
}

std::string_view as_text(Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string without_key(Bytes bytes) {
    for (const auto& [start, what] : kForeignStarts) {
        if (as_text(bytes).starts_with(start)) return std::string(what);
    }
    if (is_text(bytes)) return "it is text that holds no whole array of firmware bytes";
    return "it does not begin with AA 08";
}

std::string in_hex(std::uint32_t value) {
    std::array<char, 16> digits{};
    std::snprintf(digits.data(), digits.size(), "%06X", static_cast<unsigned>(value));
    return digits.data();
}

/// Reads little-endian words, one after the other.
class Words {
  public:
    explicit Words(Bytes bytes) : bytes_(bytes) {}

    /// Nothing when less than a word is left.
    std::optional<std::uint32_t> next() {
        if (left() < 2) return std::nullopt;
        const std::uint32_t word = bytes_[at_] | static_cast<std::uint32_t>(bytes_[at_ + 1]) << 8U;
        at_ += 2;
        return word;
    }

    /// Two words, the high one first.
    std::optional<std::uint32_t> next_address() {
        const auto high = next();
        const auto low = next();
        if (!high || !low) return std::nullopt;
        return *high << 16U | *low;
    }

    bool skip(std::size_t words) {
        if (left() < 2 * words) return false;
        at_ += 2 * words;
        return true;
    }

    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

  private:
    Bytes bytes_;
    std::size_t at_{0};
};

/// Reads all blocks into `blocks`; returns the fault, empty for none.
std::string fault_of_blocks(Words& words, std::uint32_t entry, std::vector<Block>& blocks) {
    bool entered = false;
    for (int number = 1;; ++number) {
        const std::string block = "block " + std::to_string(number);
        const auto length = words.next();
        if (!length) return "it ends before " + block + " or the zero that closes it";
        if (*length == 0) break;
        const auto start = words.next_address();
        if (!start) return "it ends inside the header of " + block;
        if (*start >= kAddressEnd || *length > kAddressEnd - *start) {
            return block + " at " + in_hex(*start) + " does not fit into 22 bits of address";
        }
        if (!words.skip(*length)) return "it ends inside " + block;
        blocks.push_back({*length, *start});
        entered = entered || (entry >= *start && entry - *start < *length);
    }
    if (words.left() > 0) {
        return std::to_string(words.left()) + " bytes follow the zero that closes it";
    }
    if (!entered) return "its entry point " + in_hex(entry) + " lies in none of its blocks";
    return {};
}

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
    throw InputError(file.string() + " is no Falcon firmware: " + why + "; " +
                     where_firmware_comes_from());
}

[[noreturn]] void refuse_unreadable(const fs::path& file, const char* what) {
    throw InputError(file.string() + " " + what + " (" + std::strerror(errno) +
                     "): make it readable or choose another file");
}

/// Refuses an image of unknown content with the blocks of a known one.
void refuse_damaged(const fs::path& file, const std::vector<Block>& blocks) {
    for (const KnownImage& known : kKnownImages) {
        const auto end = std::find(known.blocks.begin(), known.blocks.end(), Block{});
        if (!std::equal(blocks.begin(), blocks.end(), known.blocks.begin(), end)) continue;
        refuse(file, "it is laid out like " + std::string(known.file) +
                         ", but its content differs: the file is damaged");
    }
}

std::string too_large(std::uintmax_t bytes) {
    return "it has " + std::to_string(bytes) + " bytes, and no firmware has more than " +
           std::to_string(kMostBytes);
}

std::vector<std::uint8_t> bytes_of_file(const fs::path& file) {
    std::error_code failed;
    const fs::file_status status = fs::status(file, failed);
    if (status.type() == fs::file_type::not_found) {
        throw InputError("there is no file " + file.string() + "; " + where_firmware_comes_from());
    }
    if (fs::is_directory(status)) refuse(file, "it is a folder");
    if (fs::exists(status) && !fs::is_regular_file(status))
        refuse(file, "it is not an ordinary file");
    const std::uintmax_t size = fs::file_size(file, failed);
    if (!failed && size > kMostBytes) refuse(file, too_large(size));

    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) refuse_unreadable(file, "cannot be opened");
    std::vector<std::uint8_t> bytes(kMostBytes + 1);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (stream.bad()) refuse_unreadable(file, "cannot be read");
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
    return bytes;
}

/// The bytes of the first array in C source, as in FalconFirmwareBinaryNvent.h, which an installed
/// libnifalcon has in place of the image; empty when there is none.
std::vector<std::uint8_t> bytes_of_c_array(std::string_view source) {
    constexpr std::string_view kSpace = " \t\r\n";
    std::size_t at = source.find('=');
    for (; at != source.npos; at = source.find('=', at + 1)) {
        at = source.find_first_not_of(kSpace, at + 1);
        if (at == source.npos || source[at] == '{') break;
    }
    if (at == source.npos) return {};

    std::vector<std::uint8_t> bytes;
    for (source.remove_prefix(at + 1);;) {
        source.remove_prefix(std::min(source.find_first_not_of(" \t\r\n,"), source.size()));
        if (source.starts_with('}')) return bytes;
        const bool hexadecimal = source.starts_with("0x") || source.starts_with("0X");
        if (hexadecimal) source.remove_prefix(2);
        std::uint8_t byte = 0;
        const auto [end, error] = std::from_chars(source.data(), source.data() + source.size(),
                                                  byte, hexadecimal ? 16 : 10);
        if (error != std::errc{}) return {};
        bytes.push_back(byte);
        source.remove_prefix(static_cast<std::size_t>(end - source.data()));
    }
}

/// As fault_of_firmware(); adds the blocks to `blocks`.
std::string fault_of(Bytes bytes, std::vector<Block>& blocks) {
    if (bytes.empty()) return "it is empty";
    if (bytes.size() > kMostBytes) return too_large(bytes.size());
    Words words(bytes);
    if (words.next() != kKey) return without_key(bytes);
    for (int k = 1; k <= kReservedWords; ++k) {
        const auto reserved = words.next();
        if (!reserved) return "it ends inside its header";
        if (*reserved != 0) return "reserved word " + std::to_string(k) + " of its header is not 0";
    }
    const auto entry = words.next_address();
    if (!entry) return "it ends inside its header";
    if (*entry >= kAddressEnd) {
        return "its entry point " + in_hex(*entry) + " does not fit into 22 bits of address";
    }
    return fault_of_blocks(words, *entry, blocks);
}

}  // namespace

std::string fault_of_firmware(std::span<const std::uint8_t> bytes) {
    std::vector<Block> blocks;
    return fault_of(bytes, blocks);
}

std::string name_of_firmware(std::string_view sha256) {
    const KnownImage* known = known_image(sha256);
    if (known == nullptr) return "an image this program has not seen before";
    return std::string(known->file) + " (" + std::string(known->origin) + ")";
}

FirmwareImage read_firmware(const std::filesystem::path& file) {
    FirmwareImage image;
    image.bytes = bytes_of_file(file);
    if (is_text(image.bytes)) {
        auto array = bytes_of_c_array(as_text(image.bytes));
        if (!array.empty()) image.bytes = std::move(array);
    }
    std::vector<Block> blocks;
    const std::string fault = fault_of(image.bytes, blocks);
    if (!fault.empty()) refuse(file, fault);
    image.sha256 = sha256_of(image.bytes);
    image.name = name_of_firmware(image.sha256);
    if (known_image(image.sha256) == nullptr) refuse_damaged(file, blocks);
    return image;
}

std::filesystem::path kept_firmware_path() {
    return program_folder("XDG_DATA_HOME", ".local/share") / "falcon-firmware.bin";
}

FirmwareImage keep_firmware(const std::filesystem::path& file) {
    FirmwareImage image = read_firmware(file);
    const fs::path kept = kept_firmware_path();
    std::error_code failed;
    make_folders(kept.parent_path(), failed);
    if (failed) {
        throw InputError("cannot make the folder " + kept.parent_path().string() +
                         " for the firmware (" + failed.message() + "): make it and try again");
    }
    write_file(kept, as_text(image.bytes));
    return image;
}

FirmwareImage kept_firmware() {
    const fs::path kept = kept_firmware_path();
    std::error_code failed;
    if (fs::status(kept, failed).type() == fs::file_type::not_found) return {};
    return read_firmware(kept);
}

std::string where_firmware_comes_from() {
    return "take nvent_firmware.bin from the folder firmware of github.com/libnifalcon/libnifalcon,"
           " FalconFirmwareBinaryNvent.h of an installed libnifalcon, or NOVINT.BIN from Novint's"
           " driver disc";
}

}  // namespace dibhr::falcon
