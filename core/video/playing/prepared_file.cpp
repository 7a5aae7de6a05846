// Images in bands of rows, each band as it differs from its neighbours or from an earlier frame.
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
constexpr std::size_t kFramesToKey = 8;
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

/// As an image of zeros and ones; null: all was seen.
std::shared_ptr<const DepthImage> unseen_of(const Frame& frame) {
    if (!frame.unseen) return nullptr;
    auto image = std::make_shared<DepthImage>();
    image->columns = frame.depth->columns;
    image->rows = frame.depth->rows;
    image->highest_level = 1.0;
    image->levels.assign(frame.unseen->begin(), frame.unseen->end());
    return image;
}

/// Calls visit(begin, end) for the numbers of each band.
template <typename Visit>
void visit_bands(const DepthImage& image, const Visit& visit) {
    const auto columns = static_cast<std::size_t>(image.columns);
    for (int row = 0; row < image.rows; row += kBandRows) {
        const int end = std::min(row + kBandRows, image.rows);
        visit(columns * static_cast<std::size_t>(row), columns * static_cast<std::size_t>(end));
    }
}

}  // namespace

void PreparedWriter::put_image(const DepthImage* image, const DepthImage* key) {
    if (image == nullptr) return append(bytes_, bytes_of(ImageHead{}));
    append(bytes_, bytes_of(ImageHead{image->columns, image->rows, image->highest_level}));
    const bool follows =
        key != nullptr && key->columns == image->columns && key->rows == image->rows;
    visit_bands(*image, [&](std::size_t begin, std::size_t end) {
        const auto part = [&](const DepthImage& of) {
            return std::span(of.levels).subspan(begin, end - begin);
        };
        const auto packed = packer_.pack(part(*image), static_cast<std::size_t>(image->columns),
                                         follows ? part(*key) : std::span<const float>());
        append(bytes_, bytes_of(static_cast<std::uint32_t>(packed.size())));
        append(bytes_, packed);
    });
}

void PreparedWriter::add(const Frame& frame) {
    const bool key = index_.size() % kFramesToKey == 0;
    if (key) key_ = {};
    bytes_.clear();
    PreparedImages images{frame.depth, frame.undilated, unseen_of(frame)};
    put_image(images.depth.get(), key_.depth.get());
    put_image(images.undilated.get(), key_.undilated.get());
    put_image(images.unseen.get(), key_.unseen.get());
    if (key) key_ = std::move(images);
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
    std::vector<double> times;
    for (const PreparedEntry& entry : index_) times.push_back(entry.media_s);
    times_ = std::make_shared<const std::vector<double>>(std::move(times));
}

std::shared_ptr<const DepthImage> PreparedReader::take_image(std::span<const std::uint8_t>& rest,
                                                             const DepthImage* key) {
    const auto take = [&](void* to, std::size_t bytes) {
        if (rest.size() < bytes) refuse();
        std::memcpy(to, rest.data(), bytes);
        rest = rest.subspan(bytes);
    };
    ImageHead head;
    take(&head, sizeof head);
    if (std::min(head.columns, head.rows) < 0 || std::max(head.columns, head.rows) > kLargestSide)
        refuse();
    if (head.columns == 0 || head.rows == 0) return nullptr;
    const std::shared_ptr<DepthImage> image = made_.take();
    image->columns = head.columns;
    image->rows = head.rows;
    image->highest_level = head.highest_level;
    if (key != nullptr) image->levels = key->levels;
    image->levels.resize(static_cast<std::size_t>(head.columns) *
                         static_cast<std::size_t>(head.rows));
    visit_bands(*image, [&](std::size_t begin, std::size_t end) {
        std::uint32_t bytes = 0;
        take(&bytes, sizeof bytes);
        if (rest.size() < bytes ||
            !unpacker_.unpack(rest.first(bytes), static_cast<std::size_t>(image->columns),
                              std::span(image->levels).subspan(begin, end - begin)))
            refuse();
        rest = rest.subspan(bytes);
    });
    return image;
}

PreparedImages PreparedReader::read(std::size_t entry, const PreparedImages& key) {
    const PreparedEntry& at = index_[entry];
    bytes_.resize(at.bytes);
    if (std::fseek(file_.get(), static_cast<long>(at.offset), SEEK_SET) != 0 ||
        std::fread(bytes_.data(), 1, bytes_.size(), file_.get()) != bytes_.size() ||
        sum_of(bytes_) != at.sum)
        refuse();
    std::span<const std::uint8_t> rest = bytes_;
    PreparedImages images;
    images.depth = take_image(rest, key.depth.get());
    images.undilated = take_image(rest, key.undilated.get());
    images.unseen = take_image(rest, key.unseen.get());
    return images;
}

bool PreparedReader::fill(Frame& frame) {
    const auto found = std::ranges::lower_bound(index_, frame.media_s, {}, &PreparedEntry::media_s);
    if (found == index_.end() || found->media_s != frame.media_s) return false;
    const auto entry = static_cast<std::size_t>(found - index_.begin());
    std::size_t key = entry;
    while (index_[key].key == 0 && key > 0) --key;
    if (read_ != key) {
        read_.reset();
        key_ = read(key, {});
        read_ = key;
    }
    const PreparedImages images = key == entry ? key_ : read(entry, key_);
    frame.depth = images.depth;
    frame.undilated = images.undilated;
    frame.unseen.reset();
    if (images.unseen)
        frame.unseen = std::make_shared<const std::vector<std::uint8_t>>(
            images.unseen->levels.begin(), images.unseen->levels.end());
    frame.cleaning = {steps_of(found->steps), finger_};
    return frame.depth != nullptr;
}

}  // namespace dibhr
