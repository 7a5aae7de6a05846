// Images in bands of rows, each band as it differs from its neighbours or from the frame before.
#include "core/video/playing/prepared_file.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "core/files/names.hpp"

namespace dibhr {

namespace {

constexpr std::array<char, 8> kMagic{'d', 'i', 'b', 'h', 'r', 'P', '0', '1'};
constexpr std::size_t kFramesToKey = 8;  // a jump reads so many at most
constexpr int kBandRows = 64;
constexpr int kLargestSide = 1 << 16;

/// The end of the file.
struct Trailer {
    std::uint64_t index_offset{0};
    std::uint64_t frames{0};
    std::uint64_t index_sum{0};
    std::array<char, 8> magic{kMagic};
};

/// Before the bands of an image.
struct ImageHead {
    std::int32_t columns{0}, rows{0};
    double highest_level{0.0};
};

/// Tells damaged bytes from whole ones. FNV-1a over words of eight bytes.
std::uint64_t sum_of(std::span<const std::uint8_t> bytes) noexcept {
    std::uint64_t sum = 0xCBF29CE484222325U;
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
        sum = (sum ^ word) * 0x100000001B3U;
        sum ^= sum >> 29U;
    }
    return sum;
}

template <typename Value>
std::span<const std::uint8_t> bytes_of(const Value& value) noexcept {
    static_assert(std::is_trivially_copyable_v<Value>);
    return {reinterpret_cast<const std::uint8_t*>(&value), sizeof value};
}

std::string_view as_text(std::span<const std::uint8_t> bytes) noexcept {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void append(std::vector<std::uint8_t>& to, std::span<const std::uint8_t> bytes) {
    to.insert(to.end(), bytes.begin(), bytes.end());
}

std::uint32_t bits_of(const CleaningSteps& steps) {
    std::uint32_t bits = 0;
    std::uint32_t bit = 1;
    visit_steps(steps, [&](const char*, bool on) {
        if (on) bits |= bit;
        bit <<= 1U;
    });
    return bits;
}

CleaningSteps steps_of(std::uint32_t bits) {
    CleaningSteps steps;
    visit_steps(steps, [&](const char*, bool& on) {
        on = (bits & 1U) != 0;
        bits >>= 1U;
    });
    return steps;
}

PreparedImage prepared(const std::shared_ptr<const DepthImage>& image) {
    if (!image) return {};
    return {image->columns, image->rows, image->highest_level, image->levels};
}

bool same_form(const PreparedImage& a, const PreparedImage& b) noexcept {
    return a.columns == b.columns && a.rows == b.rows;
}

/// Calls visit(begin, end) for the numbers of each band.
template <typename Visit>
void visit_bands(const PreparedImage& image, const Visit& visit) {
    const auto columns = static_cast<std::size_t>(image.columns);
    for (int row = 0; row < image.rows; row += kBandRows) {
        const int end = std::min(row + kBandRows, image.rows);
        visit(columns * static_cast<std::size_t>(row), columns * static_cast<std::size_t>(end));
    }
}

}  // namespace

void PreparedWriter::put_image(PreparedImage image, PreparedImage& before, bool key) {
    append(bytes_, bytes_of(ImageHead{image.columns, image.rows, image.highest_level}));
    const bool follows = !key && same_form(image, before);
    visit_bands(image, [&](std::size_t begin, std::size_t end) {
        const auto part = [&](const PreparedImage& of) {
            return std::span(of.values).subspan(begin, end - begin);
        };
        const auto packed = packer_.pack(part(image), static_cast<std::size_t>(image.columns),
                                         follows ? part(before) : std::span<const float>());
        append(bytes_, bytes_of(static_cast<std::uint32_t>(packed.size())));
        append(bytes_, packed);
    });
    before = std::move(image);
}

void PreparedWriter::add(const Frame& frame) {
    const bool key = index_.size() % kFramesToKey == 0;
    bytes_.clear();
    put_image(prepared(frame.depth), last_.depth, key);
    put_image(prepared(frame.undilated), last_.undilated, key);
    PreparedImage unseen;
    if (frame.unseen)
        unseen = {frame.depth->columns, frame.depth->rows, 1.0,
                  std::vector<float>(frame.unseen->begin(), frame.unseen->end())};
    put_image(std::move(unseen), last_.unseen, key);
    file_.write(as_text(bytes_));
    index_.push_back({.media_s = frame.media_s,
                      .offset = offset_,
                      .bytes = bytes_.size(),
                      .sum = sum_of(bytes_),
                      .steps = bits_of(frame.cleaning.steps),
                      .key = key ? 1U : 0U});
    offset_ += bytes_.size();
}

void PreparedWriter::finish() {
    const std::span<const std::uint8_t> index{reinterpret_cast<const std::uint8_t*>(index_.data()),
                                              index_.size() * sizeof(PreparedEntry)};
    file_.write(as_text(index));
    file_.write(as_text(bytes_of(Trailer{offset_, index_.size(), sum_of(index)})));
    file_.commit();
}

void PreparedReader::refuse() const {
    throw InputError("the prepared surface " + shown(name_) +
                     " is damaged: the recording is cleaned while it plays; prepare it again");
}

PreparedReader::PreparedReader(std::filesystem::path file, const Fingertip& finger)
    : name_(std::move(file)), finger_(finger), file_(std::fopen(name_.c_str(), "rbe")) {
    Trailer trailer;
    if (!file_ || std::fseek(file_.get(), -static_cast<long>(sizeof trailer), SEEK_END) != 0)
        refuse();
    const long end = std::ftell(file_.get());
    if (end < 0 || std::fread(&trailer, sizeof trailer, 1, file_.get()) != 1) refuse();
    const auto index_bytes = trailer.frames * sizeof(PreparedEntry);
    if (trailer.magic != kMagic || trailer.index_offset > static_cast<std::uint64_t>(end) ||
        trailer.frames > static_cast<std::uint64_t>(end) / sizeof(PreparedEntry) ||
        trailer.index_offset + index_bytes != static_cast<std::uint64_t>(end))
        refuse();
    index_.resize(trailer.frames);
    if (std::fseek(file_.get(), static_cast<long>(trailer.index_offset), SEEK_SET) != 0 ||
        std::fread(index_.data(), sizeof(PreparedEntry), index_.size(), file_.get()) !=
            index_.size() ||
        sum_of({reinterpret_cast<const std::uint8_t*>(index_.data()), index_bytes}) !=
            trailer.index_sum)
        refuse();
}

void PreparedReader::take_image(std::span<const std::uint8_t>& rest, PreparedImage& image) {
    const auto take = [&](void* to, std::size_t bytes) {
        if (rest.size() < bytes) refuse();
        std::memcpy(to, rest.data(), bytes);
        rest = rest.subspan(bytes);
    };
    ImageHead head;
    take(&head, sizeof head);
    if (std::min(head.columns, head.rows) < 0 || std::max(head.columns, head.rows) > kLargestSide)
        refuse();
    image.columns = head.columns;
    image.rows = head.rows;
    image.highest_level = head.highest_level;
    image.values.resize(static_cast<std::size_t>(head.columns) *
                        static_cast<std::size_t>(head.rows));
    visit_bands(image, [&](std::size_t begin, std::size_t end) {
        std::uint32_t bytes = 0;
        take(&bytes, sizeof bytes);
        if (rest.size() < bytes ||
            !unpacker_.unpack(rest.first(bytes), static_cast<std::size_t>(image.columns),
                              std::span(image.values).subspan(begin, end - begin)))
            refuse();
        rest = rest.subspan(bytes);
    });
}

void PreparedReader::read(std::size_t entry) {
    const PreparedEntry& at = index_[entry];
    bytes_.resize(at.bytes);
    if (std::fseek(file_.get(), static_cast<long>(at.offset), SEEK_SET) != 0 ||
        std::fread(bytes_.data(), 1, bytes_.size(), file_.get()) != bytes_.size() ||
        sum_of(bytes_) != at.sum)
        refuse();
    std::span<const std::uint8_t> rest = bytes_;
    for (PreparedImage* const image : {&now_.depth, &now_.undilated, &now_.unseen})
        take_image(rest, *image);
    read_ = entry;
}

std::shared_ptr<const DepthImage> PreparedReader::image_of(const PreparedImage& prepared) {
    if (prepared.values.empty()) return nullptr;
    const std::shared_ptr<DepthImage> image = made_.take();
    image->columns = prepared.columns;
    image->rows = prepared.rows;
    image->highest_level = prepared.highest_level;
    image->levels = prepared.values;
    return image;
}

bool PreparedReader::fill(Frame& frame) {
    const auto found = std::ranges::lower_bound(index_, frame.media_s, {}, &PreparedEntry::media_s);
    if (found == index_.end() || found->media_s != frame.media_s) return false;
    const auto entry = static_cast<std::size_t>(found - index_.begin());
    if (read_ != entry) {
        std::size_t from = entry;
        const std::optional<std::size_t> before = std::exchange(read_, std::nullopt);
        while (index_[from].key == 0 && !(before && from == *before + 1)) {
            if (from == 0) refuse();
            --from;
        }
        for (; from <= entry; ++from) read(from);
    }
    frame.depth = image_of(now_.depth);
    frame.undilated = image_of(now_.undilated);
    frame.unseen.reset();
    if (!now_.unseen.values.empty())
        frame.unseen = std::make_shared<const std::vector<std::uint8_t>>(now_.unseen.values.begin(),
                                                                         now_.unseen.values.end());
    frame.cleaning = {steps_of(found->steps), finger_};
    return frame.depth != nullptr;
}

}  // namespace dibhr
