// Checks the attributes of OpenEXR headers: a name, a type, a length, a value each.
#include "core/video/formats/still_picture.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

struct FixedType {
    std::string_view name;
    std::uint32_t bytes;
};

/// The types with values of fixed length, by "OpenEXR File Layout".
constexpr std::array kFixedTypes{FixedType{"box2f", 16},
                                 FixedType{"box2i", 16},
                                 FixedType{"chromaticities", 32},
                                 FixedType{"compression", 1},
                                 FixedType{"deepImageState", 1},
                                 FixedType{"double", 8},
                                 FixedType{"envmap", 1},
                                 FixedType{"float", 4},
                                 FixedType{"int", 4},
                                 FixedType{"keycode", 28},
                                 FixedType{"lineOrder", 1},
                                 FixedType{"m33d", 72},
                                 FixedType{"m33f", 36},
                                 FixedType{"m44d", 128},
                                 FixedType{"m44f", 64},
                                 FixedType{"rational", 8},
                                 FixedType{"tiledesc", 9},
                                 FixedType{"timecode", 8},
                                 FixedType{"v2d", 16},
                                 FixedType{"v2f", 8},
                                 FixedType{"v2i", 8},
                                 FixedType{"v3d", 24},
                                 FixedType{"v3f", 12},
                                 FixedType{"v3i", 12}};

class HeaderWalk {
  public:
    explicit HeaderWalk(const std::filesystem::path& file)
        : in_(file, std::ios::binary), left_(size_of(file)) {}

    /// Skips the magic number and the flags. Whether the file has several parts.
    bool begin() {
        constexpr std::uint32_t kSeveralParts = 0x1000;
        skip(4);
        return (number() & kSeveralParts) != 0;
    }

    /// Skips one attribute. Returns its name, empty at the end of a header; nothing when it is
    /// invalid.
    std::optional<std::string> next() {
        std::string name = word();
        if (name.empty()) return valid_ ? std::optional(name) : std::nullopt;
        const std::string type = word();
        const std::uint32_t bytes = number();
        if (bytes > left_) return std::nullopt;
        const std::uint64_t end = left_ - bytes;
        if (type == "chlist") skip_channels();
        if (type == "preview") require_preview(bytes);
        if (type == "stringvector") skip_strings(end);
        const auto* const fixed =
            std::find_if(kFixedTypes.begin(), kFixedTypes.end(),
                         [&type](const FixedType& known) { return known.name == type; });
        if (fixed != kFixedTypes.end() && fixed->bytes != bytes) return std::nullopt;
        if (type == "chlist" && left_ != end) return std::nullopt;
        if (!valid_ || left_ < end) return std::nullopt;
        skip(left_ - end);
        return name;
    }

  private:
    void skip(std::uint64_t bytes) {
        valid_ = valid_ && bytes <= left_;
        if (!valid_) return;
        in_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
        left_ -= bytes;
    }

    std::uint32_t number() {
        std::array<std::uint8_t, 4> little{};
        in_.read(reinterpret_cast<char*>(little.data()), little.size());
        valid_ = valid_ && in_ && left_ >= little.size();
        if (valid_) left_ -= little.size();
        return little[0] | std::uint32_t{little[1]} << 8U | std::uint32_t{little[2]} << 16U |
               std::uint32_t{little[3]} << 24U;
    }

    /// Reads up to a zero byte, at most 255 letters.
    std::string word() {
        std::array<char, 256> letters{};
        in_.getline(letters.data(), letters.size(), '\0');
        const auto bytes = static_cast<std::uint64_t>(in_.gcount());
        valid_ = valid_ && in_ && !in_.eof() && bytes <= left_;
        if (!valid_) return {};
        left_ -= bytes;
        return letters.data();
    }

    void skip_channels() {
        constexpr std::uint64_t kChannelBytes = 16;
        while (!word().empty() && valid_) skip(kChannelBytes);
    }

    void require_preview(std::uint32_t bytes) {
        const std::uint64_t columns = number();
        const std::uint64_t rows = number();
        valid_ = valid_ && columns < 65536 && rows < 65536 && 8 + 4 * columns * rows == bytes;
    }

    void skip_strings(std::uint64_t end) {
        while (valid_ && left_ > end) skip(number());
        valid_ = valid_ && left_ == end;
    }

    std::ifstream in_;
    std::uint64_t left_;
    bool valid_{true};
};

}  // namespace

bool has_valid_exr_header(const std::filesystem::path& file) {
    HeaderWalk walk(file);
    const bool several = walk.begin();
    bool at_begin = true;  // of a part's header; an empty header ends the list of parts
    while (const auto name = walk.next()) {
        if (name->empty() && (!several || at_begin)) return true;
        at_begin = name->empty();
    }
    return false;
}

}  // namespace dibhr
