// Prepared recordings: their records, and how they are made, found and bounded.
#include "core/video/playing/prepared_cache.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/cache_folder.hpp"
#include "core/files/content_files.hpp"
#include "core/files/json.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/cleaning/surface_version.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/sources/layouts/picture_lists.hpp"
#include "core/video/sources/layouts/picture_pattern.hpp"
#include "core/video/sources/reading_versions.hpp"
#include "core/video/sources/sidecar.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kVersion = 1;
constexpr const char* kRecord = "prepared.json";
constexpr const char* kSurface = "surface";
constexpr const char* kWhat = "a prepared surface";

/// What else than files and cleaning decides the bits of a surface.
std::string made_by() {
    return "surface " + std::to_string(kSurfaceVersion) + "; " + reading_versions();
}

std::string meaning_of(const MediaDescription& media) {
    std::string text = media.meaning ? toml_of(media.meaning->statement()) : "as in the file\n";
    text += "registered by " + media.registered_by + "\ntimes from " + media.times_from;
    if (media.noise) text += "\nnoise " + text_of(*media.noise);
    return text;
}

std::string text_of(const CleaningSteps& steps) {
    std::string text;
    visit_steps(steps, [&](const char* name, bool on) {
        if (on) text.append(text.empty() ? "" : " ").append(name);
    });
    return text;
}

CleaningSteps steps_in(const std::string& text) {
    CleaningSteps steps;
    const std::string words = " " + text + " ";
    visit_steps(steps, [&](const char* name, bool& on) {
        on = words.find(" " + std::string(name) + " ") != std::string::npos;
    });
    return steps;
}

std::string text_of(const CleaningOptions& options) {
    std::string text(name_of(options.preset));
    if (options.preset == CleaningPreset::own) text += ": " + text_of(options.own);
    if (options.finger.radius_px > 0.0)
        text += ", finger " + number_text(options.finger.radius_px) + " px of " +
                number_text(options.finger.relief_px);
    return text;
}

Json json_of(const CleaningPlan& plan) {
    Json json{{"steps", text_of(plan.steps)},
              {"finger_px", plan.finger.radius_px},
              {"finger_relief_px", plan.finger.relief_px},
              {"noise", text_of(plan.noise)}};
    if (plan.felt) {
        json["felt"] = {{"steps", text_of(plan.felt->steps)},
                        {"buzz_N", plan.felt->buzz_N},
                        {"raw_N", plan.felt->raw_N}};
        if (plan.felt->relief) json["felt"]["relief"] = *plan.felt->relief;
    }
    return json;
}

CleaningPlan plan_in(const Json& json) {
    CleaningPlan plan{.steps = steps_in(json.at("steps")),
                      .finger = {json.at("finger_px"), json.at("finger_relief_px")},
                      .noise = noise_in(json.at("noise")).value_or(DepthNoise{})};
    if (!json.contains("felt")) return plan;
    const Json& felt = json.at("felt");
    plan.felt = {steps_in(felt.at("steps")), felt.at("buzz_N"), felt.at("raw_N"),
                 finite_number_in(felt, "relief")};
    return plan;
}

void keep_record(const fs::path& folder, const PreparedRecord& record) {
    const auto source = [](const PreparedSource& one) {
        return Json{{"file", one.content.file.string()},
                    {"bytes", one.content.bytes},
                    {"sha256", one.content.sha256},
                    {"changed_ns", one.changed_ns}};
    };
    const Json json{{"version", kVersion},
                    {"made_by", record.made_by},
                    {"sources", json_list(record.sources, source)},
                    {"meaning", record.meaning},
                    {"cleaning", record.cleaning},
                    {"plan", json_of(record.plan)},
                    {"frames", record.frames},
                    {"columns", record.columns},
                    {"rows", record.rows},
                    {"duration_s", record.duration_s}};
    write_file(folder / kRecord, json_text(json));
}

std::optional<PreparedRecord> record_in(const fs::path& folder) try {
    std::ifstream in(folder / kRecord, std::ios::binary);
    if (!in) return std::nullopt;
    const Json json = parsed_json(std::string(std::istreambuf_iterator<char>(in), {}));
    if (json.at("version") != kVersion) return std::nullopt;
    PreparedRecord record{.meaning = json.at("meaning"),
                          .cleaning = json.at("cleaning"),
                          .made_by = json.at("made_by"),
                          .plan = plan_in(json.at("plan")),
                          .frames = json.at("frames"),
                          .columns = json.at("columns"),
                          .rows = json.at("rows"),
                          .duration_s = json.at("duration_s")};
    for (const Json& one : json.at("sources"))
        record.sources.push_back({{.file = one.at("file").get<std::string>(),
                                   .bytes = one.at("bytes"),
                                   .sha256 = one.at("sha256")},
                                  one.at("changed_ns")});
    return record;
} catch (const std::exception&) {  // truncated, or no record: it is not used
    return std::nullopt;
}

/// The places of the recording, each once.
std::vector<fs::path> places_of(const MediaDescription& media) {
    std::vector<fs::path> places;
    for (const fs::path& place : {media.colour_path, media.depth_path})
        if (!place.empty() && (places.empty() || places.front() != place)) places.push_back(place);
    return places;
}

std::int64_t changed_ns(const fs::path& place) {
    std::int64_t newest = 0;
    for (const fs::path& file : content_files(place)) {
        const auto since = fs::last_write_time(file).time_since_epoch();
        newest = std::max<std::int64_t>(
            newest, std::chrono::duration_cast<std::chrono::nanoseconds>(since).count());
    }
    return newest;
}

/// A file that was not touched since is not read again.
bool is_unchanged(const PreparedSource& source, const fs::path& place) try {
    if (content_bytes(place) != source.content.bytes) return false;
    std::error_code failed;
    const fs::path whole = fs::absolute(place, failed).lexically_normal();
    return (whole == source.content.file && changed_ns(place) == source.changed_ns) ||
           has_content(place, source.content);
} catch (const fs::filesystem_error&) {
    return false;
}

bool fits(const PreparedRecord& record, const MediaDescription& media,
          const CleaningOptions& cleaning) {
    const std::vector<fs::path> places = places_of(media);
    return record.made_by == made_by() && record.cleaning == text_of(cleaning) &&
           record.meaning == meaning_of(media) && record.sources.size() == places.size() &&
           std::equal(places.begin(), places.end(), record.sources.begin(),
                      [](const fs::path& place, const PreparedSource& source) {
                          return is_unchanged(source, place);
                      });
}

void require_preparable(const MediaDescription& media) {
    for (const fs::path& place : places_of(media)) {
        std::error_code failed;
        if (media.live || !fs::exists(place, failed))
            throw InputError(shown(place) + " is live or a pattern of names, which are not " +
                             "prepared: give a recording's file or folder");
        if (is_picture_list(place))
            throw InputError(shown(place) +
                             " is a list of pictures, which is not prepared: give the folder of "
                             "the pictures");
    }
}

PreparedRecord new_record(const MediaDescription& media, const CleaningOptions& cleaning) {
    PreparedRecord record{.meaning = meaning_of(media),
                          .cleaning = text_of(cleaning),
                          .made_by = made_by(),
                          .columns = media.depth_columns,
                          .rows = media.depth_rows};
    for (const fs::path& place : places_of(media)) {
        std::error_code failed;
        record.sources.push_back({{.file = fs::absolute(place, failed).lexically_normal(),
                                   .bytes = content_bytes(place),
                                   .sha256 = sha256_of_file(place)},
                                  changed_ns(place)});
    }
    return record;
}

std::string key_of(const PreparedRecord& record) {
    std::string key = record.made_by + "\n" + record.meaning + "\n" + record.cleaning;
    for (const PreparedSource& source : record.sources) key += "\n" + source.content.sha256;
    return key;
}

/// Removes those used longest ago, until the rest and the new one fit.
std::size_t make_room(const fs::path& cache, const fs::path& stays, std::uintmax_t most_bytes) {
    std::vector<KeptRecording> all = kept_recordings(cache);
    std::uintmax_t bytes = 0;
    for (const KeptRecording& kept : all) bytes += kept.bytes;
    std::size_t removed = 0;
    for (; bytes > most_bytes && !all.empty(); all.pop_back()) {
        const KeptRecording& oldest = all.back();
        if (oldest.folder == stays || !forget_recording(oldest)) continue;
        bytes -= oldest.bytes;
        ++removed;
    }
    return removed;
}

/// Fills the folder. False: it was broken off.
bool write_surface(FrameReader& reader, const fs::path& folder, PreparedRecord& record,
                   const std::function<bool(double)>& progress) {
    PreparedWriter writer(folder / kSurface);
    const auto all = static_cast<double>(std::max<std::int64_t>(reader.description().frames, 1));
    for (auto frame = reader.at(0.0); frame; frame = reader.after(frame->media_s)) {
        writer.add(*frame);
        ++record.frames;
        record.duration_s = frame->media_s + reader.last_interval_s(frame->media_s);
        if (progress && !progress(std::min(static_cast<double>(record.frames) / all, 1.0)))
            return false;
    }
    if (record.frames == 0)
        throw InputError(shown(reader.description().depth_path) +
                         " holds no picture: choose another recording");
    record.plan = reader.whole_plan();
    writer.finish();
    return true;
}

}  // namespace

std::vector<KeptRecording> kept_recordings(const fs::path& cache) {
    std::vector<fs::path> folders = cache_folders(cache);
    std::ranges::sort(folders, std::greater{}, last_use);
    std::vector<KeptRecording> all;
    for (const fs::path& folder : folders) {
        KeptRecording kept{
            .folder = folder, .record = record_in(folder), .bytes = bytes_in(folder)};
        kept.is_current = kept.record && kept.record->made_by == made_by();
        all.push_back(std::move(kept));
    }
    return all;
}

bool forget_recording(const KeptRecording& kept) {
    return remove_cache_folder(kept.folder, kWhat);
}

std::unique_ptr<PreparedSurface> find_prepared(const MediaDescription& media,
                                               const CleaningOptions& cleaning) {
    if (media.prepared_in.empty()) return nullptr;
    for (const fs::path& folder : cache_folders(media.prepared_in)) {
        const std::optional<PreparedRecord> record = record_in(folder);
        if (!record || !fits(*record, media, cleaning)) continue;
        try {
            PreparedReader reader(folder / kSurface, record->plan.finger);
            note_use(folder);
            return std::make_unique<PreparedSurface>(
                PreparedSurface{folder, std::move(reader), record->plan});
        } catch (const InputError&) {
            clear_away(folder / kRecord);
            throw;
        }
    }
    return nullptr;
}

void drop_prepared(const PreparedSurface& damaged) noexcept {
    clear_away(damaged.folder / kRecord);
}

std::optional<Prepared> prepare(std::unique_ptr<Media> media, const PrepareRequest& request) {
    require_preparable(media->description());
    PreparedRecord record = new_record(media->description(), request.cleaning);
    const CacheFolder folder(
        request.cache, key_of(record), kWhat,
        "another dibhr is preparing this recording already: wait for it, or end it there");
    Prepared made{.folder = folder.path()};
    if (const auto kept = record_in(folder.path()); kept && !request.again) {
        made.was_kept = true;
        made.frames = kept->frames;
    } else {
        folder.empty();
        FrameReader reader(std::move(media));
        reader.use_no_prepared();
        reader.set_cleaning(request.cleaning);
        if (!write_surface(reader, folder.path(), record, request.progress)) {
            clear_away(folder.path());
            return std::nullopt;
        }
        keep_record(folder.path(), record);
        made.frames = record.frames;
    }
    note_use(folder.path());
    made.bytes = bytes_in(folder.path());
    made.removed = make_room(request.cache, folder.path(), request.most_bytes);
    return made;
}

}  // namespace dibhr
