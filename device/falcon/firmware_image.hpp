// A user's firmware file, checked before a byte of it is sent (README.md, Firmware images).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dibhr::falcon {

/// Why these bytes are no TI C28x SCI boot stream, as part of a sentence ("it ends inside a
/// block"); empty when they are one.
[[nodiscard]] std::string fault_of_firmware(std::span<const std::uint8_t> bytes);

/// Name of the image with this SHA-256 (64 hexadecimal digits): "nvent_firmware.bin (Novint
/// nVent)", or "an image this program has not seen before".
[[nodiscard]] std::string name_of_firmware(std::string_view sha256);

struct FirmwareImage {
    std::vector<std::uint8_t> bytes{};
    std::string name{};    ///< as name_of_firmware()
    std::string sha256{};  ///< 64 hexadecimal digits

    [[nodiscard]] bool empty() const noexcept { return bytes.empty(); }
};

/// Reads an image, or the bytes in the header FalconFirmwareBinaryNvent.h. Throws InputError when
/// the file cannot be read, is no firmware, or has the blocks of a known image with other content;
/// its text has the reason and where to get a firmware file.
[[nodiscard]] FirmwareImage read_firmware(const std::filesystem::path& file);

/// $XDG_DATA_HOME/dibhr/falcon-firmware.bin, or ~/.local/share/dibhr/falcon-firmware.bin: where an
/// accepted file is kept.
[[nodiscard]] std::filesystem::path kept_firmware_path();

/// Checks `file` as read_firmware() and keeps a copy. Throws InputError.
FirmwareImage keep_firmware(const std::filesystem::path& file);

/// The kept image; empty when none is kept. Throws InputError when the kept file is damaged.
[[nodiscard]] FirmwareImage kept_firmware();

/// Which file is needed and where to get it: "take nvent_firmware.bin from ...", without a full
/// stop.
[[nodiscard]] std::string where_firmware_comes_from();

}  // namespace dibhr::falcon
