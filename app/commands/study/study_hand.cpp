// Runs the ticks of the modelled hand and records them.
#include "app/commands/study/study_hand.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "app/settings/assets_path.hpp"
#include "app/settings/study_values.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/loop/tick_runner.hpp"
#include "core/session/recorder.hpp"
#include "core/study/protocol.hpp"
#include "core/video/cleaning/surface_version.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

namespace {

constexpr std::uint32_t kMedia = 1;

void require_sample_media(const StudyInterval& interval) {
    const auto media = interval.values.words.find("media");
    if (media != interval.values.words.end() && media->second != kSampleMedia)
        throw InputError("the modelled hand explores the built-in sample, not the media " +
                         in_quotes(media->second) + ": choose another pilot");
}

TouchParameters parameters_of(const TouchRequest& request) {
    TouchParameters parameters;
    request.given.apply(parameters);
    return parameters;
}

/// Runs and records ticks without waiting for a clock: one a millisecond.
class SimulatedHandLoop {
  public:
    SimulatedHandLoop(const std::filesystem::path& session, const SessionFacts& facts)
        : recorder_(session, *ring_, facts) {
        const SampleFiles files = sample_files();
        recorder_.media(kMedia, files.colour, files.depth);
    }

    /// Runs the ticks of the next interval.
    void explore(const DepthClip& clip, const PathRun& path, int updates,
                 const TouchRequest& request, const TouchParameters& parameters) {
        const std::uint64_t version = ++version_;
        recorder_.mark_at(kUpdate_s * static_cast<double>(tick_ + 1),
                          "interval " + std::to_string(version));
        recorder_.parameters({.version = version,
                              .touch = parameters,
                              .limits = {},
                              .bump = {request.given.bump_file()}});
        if (version > 1) runner_.release_contact();  // also without contact
        std::shared_ptr<const BumpMap> bump = request.given.read_bumps();
        stretch(bump, clip.columns(), clip.rows(), parameters.shape.bump_size_px);
        const auto count = std::min(path.goals.size(), static_cast<std::size_t>(updates));
        for (std::size_t k = 0; k < count; ++k) {
            const double t_s = path.times_s.empty() ? seconds_of(k) : path.times_s[k];
            const TickInput input{.pair = clip.blend_at(t_s),
                                  .bump = bump.get(),
                                  .goal = path.goals[k],
                                  .safety = {.dt_s = kUpdate_s, .from_zero = k == 0},
                                  .releases_contact = k == 0 && version > 1};
            const Touch& touch = runner_.run(input, {parameters, SafetyLimits{}});
            TickRecord row = runner_.record_of(input);
            row.tick = ++tick_;
            row.t_s = kUpdate_s * static_cast<double>(tick_);
            row.settings = version;
            row.frames.source.media = kMedia;
            add_result(row, touch);
            while (!ring_->push(row)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    void finish() {
        const RecorderStatus status = recorder_.finish();
        if (!status.failure.empty()) throw InputError(status.failure);
    }

  private:
    const std::unique_ptr<TickRing> ring_{std::make_unique<TickRing>()};
    Recorder recorder_;
    TickRunner runner_{};
    std::uint64_t version_{0};
    std::int64_t tick_{0};
};

}  // namespace

const StudyHand::Ground& StudyHand::ground_of(const StudyInterval& interval) {
    const TouchRequest request = request_of(interval.values);
    const TouchParameters parameters = parameters_of(request);
    const CleaningPreset cleaning = request.preset.value_or(CleaningPreset::gentle);
    const bool as_experiment =
        cleaning == CleaningPreset::gentle || cleaning == CleaningPreset::raw;
    if (!as_experiment || request.finger_mm.value_or(0.0) > 0.0)
        throw InputError(
            "the modelled hand works with cleaning gentle or raw, and with a point instead of a "
            "finger: choose another pilot");
    const std::string key =
        std::string(name_of(cleaning)) + ' ' + number_text(parameters.shape.relief_px);
    const auto known = grounds_.find(key);
    if (known != grounds_.end()) return known->second;
    HumanOptions options{.raw_depth = cleaning == CleaningPreset::raw};
    options.shape.relief_px = parameters.shape.relief_px;
    SampleClip sample = read_sample(options, {});
    PathRun path = human_goals({}, sample, parameters.friction.dynamic_coefficient);
    return grounds_.emplace(key, Ground{std::move(sample), std::move(path)}).first->second;
}

void StudyHand::explore(const Trial& trial, const std::filesystem::path& session) {
    SessionFacts facts{{"program", "dibhr " DIBHR_VERSION},
                       {"device", "modelled hand"},
                       {"surface-version", std::to_string(kSurfaceVersion)}};
    facts.merge(library_versions());
    SimulatedHandLoop hand_loop(session, facts);
    for (const StudyInterval& interval : trial.intervals) {
        require_sample_media(interval);
        const Ground& ground = ground_of(interval);
        const TouchRequest request = request_of(interval.values);
        hand_loop.explore(ground.sample.depth, ground.path, updates_, request,
                          parameters_of(request));
    }
    hand_loop.finish();
}

}  // namespace dibhr
