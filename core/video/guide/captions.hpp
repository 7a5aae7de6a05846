// Captions of a recording: WebVTT, in its time.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dibhr {

/// A text from one presentation time to a later one [s].
struct Caption {
    double from_s{0.0};
    double to_s{0.0};
    std::string text{};  ///< without tags; lines end with '\n'
};

/// In the order of their begins.
struct Captions {
    std::vector<Caption> all{};

    /// The texts that are shown at that time, one a line; empty: none.
    [[nodiscard]] std::string at(double media_s) const;
};

/// The captions of a WebVTT text (https://www.w3.org/TR/webvtt1/): cues with hours or without,
/// their settings, notes, styles and tags left out. Cues that end before they begin are left out.
/// Throws InputError that begins with `name` for a text that is none.
[[nodiscard]] Captions captions_in(std::string_view text, const std::string& name);

/// The captions NAME.vtt beside a recording: of cup_depth.mp4 cup.vtt; null: there are none. Throws
/// InputError: which file, and what to do.
[[nodiscard]] std::shared_ptr<const Captions> read_captions(const std::filesystem::path& depth);

}  // namespace dibhr
