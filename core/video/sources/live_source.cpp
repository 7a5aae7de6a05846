// Splits the pictures of a feed into colour and depth, and guesses which they are.
#include "core/video/sources/live_source.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/byte_code.hpp"
#include "core/video/depth/hue_code.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/formats/picture_source.hpp"
#include "core/video/sources/packed.hpp"
#include "core/video/sources/picture_kind.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;
using Clock = LiveFeed::Clock;

constexpr std::chrono::seconds kPictureTimeout{6};  ///< without a picture: an error
/// Where packets arrive: wait for a key frame, which encoders send every 250 frames by default.
constexpr std::chrono::seconds kKeyFrameTimeout{12};
constexpr int kMostSamples = 10;  ///< a third of a second
constexpr int kLiveKindSamples = 4;

/// The position of one reader in a feed.
struct LiveCursor {
    std::shared_ptr<LiveFeed> feed{};
    std::shared_ptr<const LivePair> pair{};
    double first_s{0.0};     ///< stamp of the first depth picture
    std::int64_t index{-1};  ///< of the pair, counted from the first
    bool is_read{false};     ///< next() has returned a pair

    /// The first time, takes the newest pair, or the one that the opening inspected last: a stream
    /// may have ended since. Then waits for the next pair. Throws InputError when none arrives.
    void take_next() {
        if (std::exchange(is_read, true)) return advance();
        auto newest = feed->after(pair->number, Clock::now());
        if (!newest) return;
        pair = std::move(newest);
        ++index;
    }
    /// Waits for the next pair. Throws InputError when none arrives.
    void advance() {
        if (!goes_on()) throw InputError(why_none());
    }
    /// Waits for the next pair. False: none will arrive.
    bool goes_on() {
        const std::uint64_t number = pair ? pair->number : 0;
        const auto begin = Clock::now();
        auto next = feed->after(number, begin + kPictureTimeout);
        if (!next && feed->signal().packet_received)
            next = feed->after(number, begin + kKeyFrameTimeout);
        if (!next) return false;
        if (!pair) first_s = next->depth.stamp_s;
        pair = std::move(next);
        ++index;
        return true;
    }
    [[nodiscard]] std::string why_none() const {
        const LiveSignal signal = feed->signal();
        if (signal.format_changed)
            return shown(feed->depth()) + " now sends pictures of another form: open it again";
        if (!signal.trouble.empty()) return signal.trouble;
        if (signal.packet_received)
            return shown(feed->depth()) +
                   " sends, but no whole key frame has come yet: let it send one more often "
                   "(-g 30), and lose less on the way";
        return "no signal from " + shown(feed->depth()) + " for " +
               std::to_string(kPictureTimeout.count()) + " s: start the sender, and check the name";
    }
};

/// Which pictures of a pair.
enum class Which { depth, depth_as_seen, colour };

class LivePictures : public PictureSource {
  public:
    /// Waits for the first pair.
    LivePictures(std::shared_ptr<LiveCursor> cursor, Which which)
        : cursor_(std::move(cursor)), which_(which) {
        if (!cursor_->pair) cursor_->advance();
        const LivePicture& first = picture();
        facts_.file = which == Which::colour ? colour_place() : cursor_->feed->depth();
        facts_.columns = mat().cols;
        facts_.rows = mat().rows;
        facts_.bits = which == Which::depth ? first.bits : 8;
        facts_.channels = first.grey || which == Which::depth ? 1 : 3;
        facts_.codec = first.codec;
        facts_.start_s = std::numeric_limits<double>::quiet_NaN();
        facts_.frames_per_s = first.frames_per_s;
        facts_.live = true;
        if (mat().empty())
            throw InputError(shown(facts_.file) +
                             " holds floating-point levels: let it send 16-bit grey");
        require_size(facts_.file, facts_.columns, facts_.rows);
    }

    [[nodiscard]] const SourceFacts& facts() const override { return facts_; }
    /// The depth source advances to the next pair; the colour source gives the present pair.
    std::optional<TimedPicture> next() override {
        if (which_ != Which::colour) cursor_->take_next();
        const double time_s = cursor_->pair->depth.stamp_s - cursor_->first_s;
        TimedPicture taken{mat(), time_s, cursor_->index};
        taken.pair = cursor_->pair;
        return taken;
    }
    void seek(double /*time_s*/) override {}
    std::vector<cv::Mat> samples(int most) override {
        std::vector<cv::Mat> pictures{mat()};
        const auto wanted = static_cast<std::size_t>(std::clamp(most, 1, kMostSamples));
        while (pictures.size() < wanted && cursor_->goes_on()) pictures.push_back(mat());
        return pictures;
    }

  private:
    [[nodiscard]] const fs::path& colour_place() const {
        const LiveFeed& feed = *cursor_->feed;
        return feed.colour().empty() ? feed.depth() : feed.colour();
    }
    [[nodiscard]] const LivePicture& picture() const {
        return which_ == Which::colour ? cursor_->pair->colour : cursor_->pair->depth;
    }
    [[nodiscard]] const cv::Mat& mat() const {
        return which_ == Which::depth ? picture().levels : picture().colour;
    }

    std::shared_ptr<LiveCursor> cursor_;
    Which which_;
    SourceFacts facts_{};
};

std::unique_ptr<PictureSource> pictures_of(const std::shared_ptr<LiveCursor>& cursor, Which which) {
    return std::make_unique<LivePictures>(cursor, which);
}

/// The code that a statement or the pictures tell; grey: none, or stated.
DepthCode code_of(const PictureGuess& guess, const DepthStatement& statement) {
    if (statement.code) return *statement.code;
    if (guess.kind == PictureKind::hue_depth) return DepthCode::hue;
    return guess.kind == PictureKind::byte_depth ? guess.code : DepthCode::grey;
}

bool is_of_colours(DepthCode code) {
    return code == DepthCode::hue || is_of_bytes(code);
}

/// Decodes depth coded as colours: as the statement says, else as the pictures look.
Sources decoded(const std::shared_ptr<LiveCursor>& cursor, const PictureGuess& guess,
                const DepthStatement& statement) {
    Sources sources;
    const DepthCode code = code_of(guess, statement);
    const bool is_ramp = !statement.code && guess.kind == PictureKind::ramp_depth;
    const bool is_coded = is_of_colours(code) || is_ramp;
    sources.depth = pictures_of(cursor, is_coded ? Which::depth_as_seen : Which::depth);
    const Finding coded = finding_on_code(code, statement.code.has_value());
    if (code == DepthCode::hue)
        sources.depth = hue_decoded(std::move(sources.depth), HueCode{}, coded);
    else if (is_of_bytes(code))
        sources.depth = byte_decoded(std::move(sources.depth), code, coded);
    else if (is_ramp)
        sources.depth = ramp_decoded(std::move(sources.depth));
    return sources;
}

Sources halves(const std::shared_ptr<LiveCursor>& cursor, const PackedForm& form) {
    auto colour = pictures_of(cursor, Which::colour);
    const bool is_coded = form.hue || form.bytes;
    return unpack(std::move(colour),
                  pictures_of(cursor, is_coded ? Which::depth_as_seen : Which::depth), form);
}

PictureGuess guess_kind_of(const std::shared_ptr<LiveCursor>& cursor) {
    return guess_kind(pictures_of(cursor, Which::depth_as_seen)->samples(kLiveKindSamples));
}

/// One connection: halves as the statement says or as the pictures look, else depth alone.
Sources of_one(const std::shared_ptr<LiveCursor>& cursor, const DepthStatement& statement) {
    const bool says_halves = statement.packing && is_of_halves(*statement.packing);
    const PictureGuess guess = guess_kind_of(cursor);
    if (says_halves || (!statement.packing && guess.kind == PictureKind::packed)) {
        PackedForm form =
            says_halves ? PackedForm{.packing = *statement.packing} : form_by_appearance(guess);
        const bool looks_hue = guess.kind == PictureKind::packed && guess.code == DepthCode::hue;
        const bool is_hue = statement.code ? *statement.code == DepthCode::hue : looks_hue;
        form.hue = is_hue ? std::optional(HueCode{}) : std::nullopt;
        if (statement.code && is_of_bytes(*statement.code)) form.bytes = *statement.code;
        form.coded =
            finding_on_code(statement.code.value_or(DepthCode::hue), statement.code.has_value());
        return halves(cursor, form);
    }
    const LivePicture& first = cursor->pair->depth;
    const bool is_depth = guess.kind != PictureKind::photo || (first.grey && first.bits > 8) ||
                          statement.code.value_or(DepthCode::grey) != DepthCode::grey ||
                          statement.packing == DepthPacking::separate;
    if (!is_depth) {
        throw InputError(shown(cursor->feed->depth()) +
                         " shows colour: give the source of its depth as the second name, or say "
                         "how the depth is in it with --packing (separate: it is all depth)");
    }
    return decoded(cursor, guess, statement);
}

/// The depth of two connections, coded as the statement says: looking at its pictures would take
/// time.
Sources of_two(const std::shared_ptr<LiveCursor>& cursor, const DepthStatement& statement) {
    Sources sources = decoded(cursor, {.kind = PictureKind::grey_depth}, statement);
    sources.colour = pictures_of(cursor, Which::colour);
    const LivePicture& first = cursor->pair->depth;
    const bool is_stated = statement.code || statement.packing == DepthPacking::separate;
    if (!is_stated && !first.grey && !first.colour.empty() && is_coloured(first.colour))
        sources.not_depth = refusal_of_colours(sources.depth->facts(), {});
    return sources;
}

}  // namespace

bool any_live(const fs::path& colour, const fs::path& depth) {
    return is_live(colour) || is_live(depth);
}

Sources find_live_sources(const fs::path& colour, const fs::path& depth,
                          const DepthStatement& statement, std::shared_ptr<LiveFeed> feed) {
    const fs::path& only = depth.empty() ? colour : depth;
    const bool two = !colour.empty() && colour != only;
    if (!is_live(only) || (two && !is_live(colour)))
        throw InputError(shown(two ? colour : only) + " and " + shown(only) +
                         " do not go together: colour and depth are both live, or both files");
    if (!feed || !feed->is_of(colour, depth) || feed->signal().format_changed)
        feed = std::make_shared<LiveFeed>(two ? colour : fs::path{}, only);
    feed->set_outputs(true, true);
    const auto cursor = std::make_shared<LiveCursor>(LiveCursor{.feed = feed});
    cursor->advance();
    const bool is_coded = is_of_colours(statement.code.value_or(DepthCode::grey));
    Sources sources;
    if (two) {
        sources = of_two(cursor, statement);
        feed->set_outputs(is_coded, !is_coded);
    } else {
        sources = of_one(cursor, statement);
        const Findings& rows = sources.depth->facts().findings;  // only those of colours
        const bool as_seen = sources.colour != nullptr || is_coded || !rows.empty() ||
                             sources.depth->facts().bits == kRealBits;
        feed->set_outputs(as_seen, true);
    }
    sources.live = std::move(feed);
    return sources;
}

}  // namespace dibhr
