// Opening files on other threads, telling colour from depth; saving pictures; when settings are
// written.
#include "app/viewer/files.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <utility>

#include "app/settings/assets_path.hpp"
#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/video/live/live_name.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/media_names.hpp"
#include "core/video/sources/picture_files.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr double kSettleTime_s = 2.0;
constexpr double kPollInterval_s = 0.25;

// Levels between channels that video compression leaves in a grey picture.
constexpr int kGreyTolerance = 12;

bool is_grey(const ColourImage& picture) {
    std::size_t coloured = 0;
    for (std::size_t k = 0; k + 2 < picture.rgb.size(); k += 3) {
        const int r = picture.rgb[k];
        const int g = picture.rgb[k + 1];
        const int b = picture.rgb[k + 2];
        if (std::abs(r - g) > kGreyTolerance || std::abs(g - b) > kGreyTolerance) ++coloured;
    }
    return coloured * 3 * 200 < picture.rgb.size();  // less than half a percent of the pixels
}

bool shows_grey(const fs::path& colour, const fs::path& depth) {
    const auto first = open_media(colour, depth)->next();
    return first && is_grey(first->colour);
}

}  // namespace

std::string new_file_name(const char* ending) {
    const auto now = std::chrono::system_clock::now();
    const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
    std::tm local{};
    localtime_r(&seconds, &local);
    char date[32];
    std::strftime(date, sizeof date, "%Y%m%d-%H%M%S", &local);
    char name[64];
    std::snprintf(name, sizeof name, "dibhr-%s-%03d.%s", date, static_cast<int>(ms.count() % 1000),
                  ending);
    return std::filesystem::absolute(name).string();
}

std::string picture_name(const ViewerState& state) {
    const fs::path& video =
        state.media.colour_path.empty() ? state.media.depth_path : state.media.colour_path;
    NameFacts facts{.file = (state.touch.replay ? state.touch.replay->file : video).stem().string(),
                    .media_s = state.media.playback.media_s,
                    .frame = state.media.playback.frame + 1};
    if (state.touch.replay) {
        facts.media_s = state.touch.replay->tick.video_s;
        facts.frame = static_cast<std::int64_t>(state.touch.replay->tick.frames.from_frame) + 1;
    }
    if (facts.file.empty()) facts.file = "dibhr";  // of a folder with a slash
    const std::time_t now = std::time(nullptr);
    localtime_r(&now, &facts.now);
    return whole_path(name_from(state.settings.screenshot_name, facts)).string();
}

void Screenshots::save(PictureOf of, ColourImage picture, const std::string& name) {
    requested_.erase(of);
    const auto write = [picture = std::move(picture), file = name + ".png"] {
        return "Saved " + write_new_png(picture, file).string();
    };
    writing_.push_back(std::async(std::launch::async, write));
}

std::optional<std::string> Screenshots::take() {
    const auto done = std::find_if(writing_.begin(), writing_.end(), [](const auto& picture) {
        return picture.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    });
    if (done == writing_.end()) return {};
    std::future<std::string> picture = std::move(*done);
    writing_.erase(done);
    return picture.get();
}

void Screenshots::finish() {
    for (auto& picture : std::exchange(writing_, {})) picture.get();
}

SettingsSaver::SettingsSaver(Settings in_file, Settings started, std::filesystem::path file,
                             TaskQueue& writing)
    : in_file_(std::move(in_file)),
      started_(std::move(started)),
      agreed_(started_),
      wanted_(in_file_),
      written_(in_file_),
      file_(std::move(file)),
      writing_(writing) {}

void SettingsSaver::poll(const Settings& now, double now_s) {
    if (now_s < next_poll_s_) return;
    next_poll_s_ = now_s + kPollInterval_s;
    const Settings wanted = merge_changes(in_file_, started_, now);
    if (!same_settings(wanted, wanted_)) {
        wanted_ = wanted;
        changed_s_ = now_s;
    }
    if (now_s - changed_s_ >= kSettleTime_s) save(now);
}

void SettingsSaver::finish(const Settings& now) {
    wanted_ = merge_changes(in_file_, started_, now);
    save(now);
}

void SettingsSaver::save(const Settings& now) {
    if (!same_settings(wanted_, written_)) {
        written_ = wanted_;
        writing_.add([settings = wanted_, file = file_] { save_settings(settings, file); });
    }
    // Also for a value that the file already has.
    if (same_settings(now, agreed_)) return;
    agreed_ = now;
    writing_.add([before = started_, now] { Consent().agree_to_changes(before, now); });
}

std::unique_ptr<Media> open_request(const OpenRequest& request) {
    fs::path colour = request.colour;
    fs::path depth = request.depth;
    if (request.in_any_order && depth.empty() && named_depth(colour)) {
        if (const auto found = find_colour_beside(colour)) depth = std::exchange(colour, *found);
    } else if (request.in_any_order && !depth.empty()) {
        const bool by_name = named_depth(colour) != named_depth(depth);
        const bool swapped = by_name ? named_depth(colour) : shows_grey(colour, depth);
        if (swapped) std::swap(colour, depth);
    }
    return open_media(colour, depth, request.request);
}

bool named_firmware(const fs::path& file) {
    // .h: the image as an installed libnifalcon has it.
    const std::string ending = file.extension().string();
    return ending == ".bin" || ending == ".BIN" || ending == ".h";
}

std::optional<OpenRequest> dropped_request(const std::vector<fs::path>& files) {
    if (files.empty() || files.size() > 2) return {};
    OpenRequest request{files.front(), files.size() == 2 ? files.back() : fs::path{}};
    request.in_any_order = true;
    return request;
}

bool is_sample(const fs::path& file) try {
    return file == sample_files().colour;
} catch (const InputError&) {  // it is not installed
    return false;
}

std::string shown_name(const fs::path& file) {
    if (is_sample(file)) return "The sample: a woman waves";
    return is_live(file) ? shown_source(file) : file.filename().string();
}

fs::path remembered_file(const MediaDescription& media) {
    const fs::path& file = media.colour_path.empty() ? media.depth_path : media.colour_path;
    return is_sample(file) ? fs::path{} : file;
}

FileMemory memory_of(const Media& media) {
    const fs::path file = remembered_file(media.description());
    return file.empty() ? FileMemory{} : read_memory(file_memories_path(), file);
}

OpenResult try_open(const OpenRequest& request) {
    try {
        OpenResult opened{.request = request};
        if (request.depth.empty() && is_session_file(request.colour)) {
            opened.session = std::make_unique<OpenedSession>(request.colour, false);
            opened.guide = find_guide(opened.session->frames.description);
        } else {
            opened.media = open_request(request);
            opened.memory = memory_of(*opened.media);
            opened.maps = find_maps(opened.media->description());
            opened.guide = find_guide(opened.media->description());
        }
        return opened;
    } catch (const DepthMissing& error) {
        return {.request = request, .failure = error.what(), .lacks_depth = true};
    } catch (const std::exception& error) {
        return {
            .request = request, .failure = error.what(), .is_folder = is_folder(request.colour)};
    }
}

}  // namespace dibhr
