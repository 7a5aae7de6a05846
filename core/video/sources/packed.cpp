// Cuts pictures into halves, and decodes depth coded as colours.
#include "core/video/sources/packed.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/byte_code.hpp"
#include "core/video/depth/colour_maps.hpp"
#include "core/video/sources/layouts/picture_folder.hpp"
#include "core/video/sources/layouts/picture_times.hpp"
#include "core/video/sources/picture_kind.hpp"
#include "core/video/sources/readers.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

bool is_side_by_side(DepthPacking packing) noexcept {
    return packing == DepthPacking::left_right || packing == DepthPacking::right_left;
}

/// Opens the longest row of pictures in a folder of packed pictures.
std::unique_ptr<PictureSource> open_longest_row(const fs::path& folder, PictureRole role) {
    PictureSet found = find_pictures_in(folder);
    const auto longest =
        std::max({&found.unnamed, &found.colour, &found.depth},
                 [](const PictureRow* a, const PictureRow* b) { return a->size() < b->size(); });
    if (longest->empty())
        throw InputError(
            shown(folder) +
            " is a folder without pictures: give the folder or the file that holds them");
    std::vector<double> times = times_s(*longest, {}, kPicturesPerSecond);
    Timing timing = timing_of(*longest, {}, {});
    return std::make_unique<PictureSequence>(folder, std::move(*longest), std::move(times), role,
                                             LayoutFacts{}, std::move(timing));
}

std::unique_ptr<PictureSource> open_whole(const fs::path& place, PictureRole role) {
    return is_folder(place) ? open_longest_row(place, role) : open_picture_source(place, role);
}

std::unique_ptr<PictureSource> cropped(std::unique_ptr<PictureSource> whole, const PackedForm& form,
                                       PictureRole role) {
    const auto crop = [packing = form.packing, gap_px = form.gap_px, role](const cv::Mat& picture) {
        return picture(half_of(picture.size(), packing, role, gap_px)).clone();
    };
    return std::make_unique<ChangedPictures>(std::move(whole), crop, [](SourceFacts&) {});
}

/// Stretches a half to its own size, and adds how the packing is known.
std::unique_ptr<PictureSource> unsqueezed(std::unique_ptr<PictureSource> half,
                                          const PackedForm& form, PictureRole role) {
    const double wide = is_side_by_side(form.packing) ? 2.0 : 0.5;
    const auto change = [aspect = form.half_size ? wide : 1.0, role](const cv::Mat& picture) {
        return with_square_pixels(picture, aspect, role);
    };
    if (role == PictureRole::colour)
        return std::make_unique<ChangedPictures>(std::move(half), change, [](SourceFacts&) {});
    const auto change_facts = [form](SourceFacts& facts) {
        Finding finding = form.finding;
        if (finding.reason.empty()) return;
        finding.statement.packing = form.packing;
        auto& camera = finding.statement.intrinsics;
        if (camera && !form.intrinsics_size.empty())
            camera =
                scaled_camera(*camera, form.intrinsics_size, cv::Size(facts.columns, facts.rows));
        facts.findings.push_back(std::move(finding));
    };
    return std::make_unique<ChangedPictures>(std::move(half), change, change_facts);
}

/// The meaning of levels decoded by this code.
DepthStatement meaning_of(const HueCode& code) {
    DepthStatement meaning;
    meaning.code = DepthCode::hue;
    meaning.near = NearLevels::dark;
    meaning.unit = code.metres ? DepthUnit::m : DepthUnit::levels;
    meaning.scale = 1.0;
    meaning.range = code.metres;
    meaning.no_data.emplace();  // 0 is a level
    return meaning;
}

/// Whether a codec is known to keep every byte of red, green and blue. Others may: it is measured.
bool is_lossless(const std::string& codec) {
    static constexpr std::array<std::string_view, 9> kLossless{"png", "tiff", "tif",  "bmp", "ppm",
                                                               "pnm", "pam",  "ffv1", "mpng"};
    return std::find(kLossless.begin(), kLossless.end(), lower_case(codec)) != kLossless.end();
}

constexpr const char* kWithoutLoss = "as PNG, or as FFV1 with -pix_fmt bgr0 (bgra for floats)";

/// Why a source does not hold the numbers of the code; empty: it may. Either its pictures are not
/// of red, green and blue as the code needs them, or their low bytes are lost.
std::string missing_bytes(PictureSource& pictures, DepthCode code) {
    constexpr int kSamples = 6;
    pictures.seek(0.0);  // samples of a video begin where it stands
    const std::vector<cv::Mat> first = pictures.samples(1);
    if (first.empty()) return {};
    const SourceFacts& facts = pictures.facts();
    const cv::Mat& picture = first.front();
    const std::string name(name_of(code));
    const bool is_luma = picture.channels() == 1 && facts.channels != 1;
    const bool has_bytes = picture.depth() == CV_8U && picture.channels() >= least_channels(code);
    if (!is_luma && !has_bytes)
        return shown(facts.file) + " does not hold depth as " + name +
               ", which is in bytes of red, green, " +
               (least_channels(code) == 4 ? "blue and alpha" : "and blue") +
               ": give the picture as it was first written, or another --depth-code";
    if (!is_luma) {
        const std::vector<cv::Mat> samples = pictures.samples(kSamples);
        const std::optional<bool> continues = is_continuous(samples, code);
        // Even numbers may be continuous as floats of both orders.
        if (continues == true && least_channels(code) == 3) return {};
        const auto other = byte_code_in(samples);
        if (other && *other != code && (continues != true || have_contrary_bytes(*other, code)))
            return shown(facts.file) + " has its bytes in another order than " + name +
                   " has: give --depth-code " + std::string(name_of(*other));
        if (continues.value_or(true) || is_lossless(facts.codec)) return {};
    }
    return shown(facts.file) + " does not keep the bytes of red, green and blue (" +
           one_line(facts.codec) + "), so that the low bytes of its depth (" + name +
           ") are lost: write it without loss, " + kWithoutLoss;
}

/// Removes what a statement says about levels, which now are others.
void forget_levels(DepthStatement& statement) {
    statement.near.reset();
    statement.unit.reset();
    statement.scale.reset();
    statement.range.reset();
    statement.no_data.reset();
}

/// Throws InputError where the pictures of a source have not the bits and channels of the code.
void require_levels(PictureSource& pictures, DepthCode code) {
    const std::vector<cv::Mat> first = pictures.samples(1);
    if (first.empty() || has_levels(first.front(), code)) return;
    throw InputError(shown(pictures.facts().file) + " does not hold depth as " +
                     std::string(name_of(code)) + ", which is in " +
                     (code == DepthCode::xyz      ? "three channels of real numbers"
                      : code == DepthCode::stereo ? "one channel"
                                                  : "one channel of 16 bits") +
                     ": give the picture as it was first written, or another --depth-code");
}

/// Whether CARLA is in the file's name or its folder's.
bool names_carla(const fs::path& file) {
    const auto holds = [](const fs::path& name) {
        return lower_case(name.filename().string()).find("carla") != std::string::npos;
    };
    return holds(file) || holds(file.parent_path());
}

struct PackingWord {
    std::string_view word;
    std::optional<DepthPacking> packing;
    bool half_size;
    bool names_depth;
};

constexpr std::array<PackingWord, 18> kPackingWords{{
    {"rgbd", std::nullopt, false, true},
    {"hrgbd", std::nullopt, true, true},
    {"half", std::nullopt, true, false},
    {"full", std::nullopt, false, false},
    {"lr", DepthPacking::left_right, false, false},
    {"lrf", DepthPacking::left_right, false, false},
    {"sbs", DepthPacking::left_right, false, false},
    {"hsbs", DepthPacking::left_right, true, false},
    {"rl", DepthPacking::right_left, false, false},
    {"rlf", DepthPacking::right_left, false, false},
    {"cross", DepthPacking::right_left, false, false},
    {"tb", DepthPacking::top_bottom, false, false},
    {"tbf", DepthPacking::top_bottom, false, false},
    {"fulltb", DepthPacking::top_bottom, false, false},
    {"htb", DepthPacking::top_bottom, true, false},
    {"ou", DepthPacking::top_bottom, false, false},
    {"hou", DepthPacking::top_bottom, true, false},
    {"bt", DepthPacking::bottom_top, false, false},
}};

const PackingWord* packing_word(const std::string& word) {
    const auto* const found =
        std::find_if(kPackingWords.begin(), kPackingWords.end(),
                     [&](const PackingWord& known) { return known.word == word; });
    return found == kPackingWords.end() ? nullptr : found;
}

}  // namespace

PackedForm form_by_appearance(const PictureGuess& guess) {
    PackedForm form{.packing = guess.packing,
                    .gap_px = guess.gap_px,
                    .finding = {{},
                                Evidence::appearance,
                                kSurenessOfAppearance,
                                "its halves, which look like a photo and its depth"}};
    if (guess.code == DepthCode::hue) {
        form.hue.emplace();
        form.coded = finding_on_code(DepthCode::hue, false);
    } else {
        form.finding.statement.code = DepthCode::grey;
    }
    return form;
}

Finding finding_on_code(DepthCode code, bool is_stated) {
    const std::string reason =
        is_stated                     ? "what " + std::string(name_of(code)) + " means"
        : code == DepthCode::hue      ? "its colours: pure hues alone"
        : code == DepthCode::kinect11 ? "its levels: 2047 alone above those of a Kinect"
        : code == DepthCode::turned16 ? "its levels: multiples of 8, as of bits turned by three"
        : code == DepthCode::depth16
            ? "its levels: distances that go on where the three highest bits change"
        : code == DepthCode::xyz ? "its channels, which are points before one camera"
                                 : "the bytes of its colours, which carry as those of numbers";
    return {{.code = code}, Evidence::code, kSurenessOfCode, reason};
}

std::unique_ptr<PictureSource> hue_decoded(std::unique_ptr<PictureSource> colours,
                                           const HueCode& code, Finding coded) {
    coded.statement.fill_in(meaning_of(code));
    const auto decode = [code](const cv::Mat& picture) {
        cv::Mat depth = hues_of(picture, code);
        if (!code.metres) return depth;
        const double near = code.metres->near;
        depth.convertTo(depth, CV_32F, code.metres->far - near, near);
        return depth;
    };
    const auto change_facts = [coded = std::move(coded)](SourceFacts& facts) {
        facts.bits = kRealBits;
        facts.channels = 1;
        facts.findings.push_back(coded);
    };
    return std::make_unique<ChangedPictures>(std::move(colours), decode, change_facts);
}

std::unique_ptr<PictureSource> ramp_decoded(std::unique_ptr<PictureSource> colours) {
    const auto change_facts = [](SourceFacts& facts) {
        facts.bits = 8;
        facts.channels = 1;
        facts.findings.push_back(
            {{.near = NearLevels::bright, .unit = DepthUnit::levels, .no_data = std::vector{0.0}},
             Evidence::appearance,
             kSurenessOfAppearance,
             "its colours: from white over cyan and blue to black"});
    };
    return std::make_unique<ChangedPictures>(std::move(colours), ramp_levels, change_facts);
}

bool may_hold_bytes(PictureSource& pictures, DepthCode code) {
    return missing_bytes(pictures, code).empty();
}

std::unique_ptr<PictureSource> byte_decoded(std::unique_ptr<PictureSource> pictures, DepthCode code,
                                            Finding coded) {
    if (const std::string missing = missing_bytes(*pictures, code); !missing.empty())
        throw InputError(missing);
    const auto decode = [code](const cv::Mat& picture) { return numbers_in_bytes(picture, code); };
    if (code == DepthCode::rgb24 && names_carla(pictures->facts().file)) {
        constexpr double kCarlaFarthest_m = 1000.0;  // carla.readthedocs.io, "Depth camera"
        constexpr double kCarlaHighest = 16777215.0;
        coded.statement.fill_in({.unit = DepthUnit::m, .scale = kCarlaFarthest_m / kCarlaHighest});
        coded.reason += ", of CARLA by its name";
    }
    coded.statement.fill_in(byte_code_meaning(code));
    const auto change_facts = [code, coded = std::move(coded)](SourceFacts& facts) {
        facts.bits = bits_in_bytes(code);
        facts.channels = 1;
        facts.findings.push_back(coded);
    };
    return std::make_unique<ChangedPictures>(std::move(pictures), decode, change_facts);
}

std::unique_ptr<PictureSource> level_decoded(std::unique_ptr<PictureSource> pictures,
                                             DepthCode code, const InverseLevels& law,
                                             Finding coded) {
    require_levels(*pictures, code);
    const auto decode = [code, law](const cv::Mat& picture) {
        return numbers_in_levels(picture, code, law);
    };
    coded.statement.code = code;
    coded.statement.fill_in(level_code_meaning(code));
    const auto change_facts = [code, coded = std::move(coded)](SourceFacts& facts) {
        facts.bits = has_whole_numbers(code) ? 16 : kRealBits;
        facts.channels = 1;
        for (Finding& other : facts.findings) forget_levels(other.statement);
        std::erase_if(facts.findings, [](const Finding& other) {
            return other.statement == DepthStatement{} && other.about.empty();
        });
        facts.findings.push_back(coded);
    };
    return std::make_unique<ChangedPictures>(std::move(pictures), decode, change_facts);
}

bool has_decoded_levels(const SourceFacts& facts) {
    return std::any_of(facts.findings.begin(), facts.findings.end(), [](const Finding& finding) {
        return finding.statement.code && is_of_levels(*finding.statement.code);
    });
}

std::string refusal_of_colours(const SourceFacts& facts, const cv::Mat& seen) {
    if (is_colour_mapped(seen))
        return shown(facts.file) +
               " is painted in false colours (such as jet or viridis), neither grey nor a known "
               "code of depth: give the numbers that it was painted from, as an array (.npy) or in "
               "grey" +
               (has_map_of_rising_brightness(seen)
                    ? ", or take its brightness by --depth-code grey"
                    : " (--depth-code grey would give a wrong relief)");
    const std::string lossless_form = facts.still ? "as PNG" : kWithoutLoss;
    const std::string first = is_lossless(facts.codec) || facts.bits == kRealBits
                                  ? ""
                                  : "write it without the losses of " + one_line(facts.codec) +
                                        ", " + lossless_form + ", and ";
    return shown(facts.file) + (facts.still ? " is a colour picture" : " holds colour pictures") +
           ", not depth: its colours are neither grey nor a known code of depth; give the depth "
           "itself, as an array (.npy) or in grey, or, if its bytes hold a code, " +
           first + "name it with --depth-code";
}

bool is_of_halves(DepthPacking packing) noexcept {
    return packing != DepthPacking::separate && packing != DepthPacking::tracks;
}

cv::Rect half_of(cv::Size picture, DepthPacking packing, PictureRole role, int gap_px) {
    const bool beside = is_side_by_side(packing);
    const bool colour_first =
        packing == DepthPacking::left_right || packing == DepthPacking::top_bottom;
    const bool first = colour_first == (role == PictureRole::colour);
    const auto part = [gap_px](int side) { return std::max(0, side - gap_px) / 2; };
    const cv::Size half(beside ? part(picture.width) : picture.width,
                        beside ? picture.height : part(picture.height));
    const cv::Point last(picture.width - half.width, picture.height - half.height);
    return {first ? cv::Point() : last, half};
}

Sources unpack(std::unique_ptr<PictureSource> for_colour, std::unique_ptr<PictureSource> for_depth,
               const PackedForm& form) {
    auto colour = cropped(std::move(for_colour), form, PictureRole::colour);
    auto depth = cropped(std::move(for_depth), form, PictureRole::depth);
    if (form.hue) depth = hue_decoded(std::move(depth), *form.hue, form.coded);
    if (form.bytes) depth = byte_decoded(std::move(depth), *form.bytes, form.coded);
    Sources sources;
    sources.colour = unsqueezed(std::move(colour), form, PictureRole::colour);
    sources.depth = unsqueezed(std::move(depth), form, PictureRole::depth);
    return sources;
}

Sources open_packed(const fs::path& place, const PackedForm& form) {
    const PictureRole read_as = form.hue ? PictureRole::colour : PictureRole::depth;
    auto for_colour = open_whole(place, PictureRole::colour);
    return unpack(std::move(for_colour), open_whole(place, read_as), form);
}

std::optional<NamedPacking> packing_by_name(const fs::path& file) {
    const std::vector<std::string> words = plain_words_of(file.stem().string());
    NamedPacking said;
    bool says = false;
    // Only words at the end count: others may mean anything.
    for (auto word = words.rbegin(); word != words.rend(); ++word) {
        const PackingWord* const known = packing_word(*word);
        if (known == nullptr && !is_of_digits(*word)) break;
        if (known == nullptr) continue;
        if (known->packing) said.packing = *known->packing;
        said.half_size = said.half_size || known->half_size;
        said.names_depth = said.names_depth || known->names_depth;
        says = says || known->packing || known->names_depth;
    }
    if (!says) return std::nullopt;
    return said;
}

}  // namespace dibhr
