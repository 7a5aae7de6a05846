// Writes a clip, and copies it to have the index at the begin.
#include "core/clip/clip_file.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

#include "core/av/track_encoder.hpp"
#include "core/clip/mp4_file.hpp"
#include "core/clip/picture_encoder.hpp"
#include "core/error.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

std::int64_t clip_time(double seconds) {
    return std::llround(seconds * kTrackUnitsPerSecond);
}

fs::path committed(OutputFile& file, const fs::path& target, ClipNameConflict name) {
    if (name == ClipNameConflict::adds_number) return file.commit_beside();
    file.commit();
    return target;
}

}  // namespace

ClipFile::ClipFile(const fs::path& target, ClipNameConflict name)
    : target_(target), name_(name), written_(target) {
    set_up_libraries();
}

ClipFile::~ClipFile() = default;

template <typename Step>
auto ClipFile::with_file_in_errors(const Step& step) {
    try {
        return step();
    } catch (const InputError& error) {
        throw InputError(target_.string() + ": " + error.what());
    }
}

void ClipFile::open(const ColourImage& first) {
    encoder_ = std::make_unique<PictureEncoder>(first.columns, first.rows);
    file_ = std::make_unique<Mp4File>(written_.written(), *encoder_->coded(), Mp4Index::in_pieces);
}

void ClipFile::add(const ColourImage& picture, double shown_s) {
    const std::int64_t shown_ms = clip_time(shown_s);
    if (shown_ms <= last_ms_ || picture.rgb.empty()) return;
    with_file_in_errors([&] {
        if (!encoder_) open(picture);
        encoder_->encode(picture, shown_ms, [this](AVPacket& packet) { file_->write(packet); });
    });
    last_ms_ = shown_ms;
}

bool ClipFile::plays() const noexcept {
    return file_ && file_->plays();
}

fs::path ClipFile::finish(double end_s, ClipEnd how) {
    return with_file_in_errors([&] {
        if (!encoder_) throw InputError("no picture was drawn while the clip went on");
        encoder_->drain([this](AVPacket& packet) { file_->write(packet); });
        const std::int64_t end_ms = std::max(clip_time(end_s), last_ms_ + 1);
        file_->finish(end_ms);
        if (how == ClipEnd::at_once) return committed(written_, target_, name_);
        try {
            OutputFile copy(target_);
            copy_with_index_at_begin(written_.written(), copy.written(), last_ms_, end_ms);
            return committed(copy, target_, name_);
        } catch (const std::exception&) {  // no room for a copy: the first file is whole, too
            return committed(written_, target_, name_);
        }
    });
}

}  // namespace dibhr
