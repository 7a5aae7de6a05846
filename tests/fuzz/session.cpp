// A session file that anybody may have made: what reads it refuses it in one line or reads it to
// its end, and replaying what it holds goes on over any numbers.
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/replay/session_replay.hpp"
#include "core/replay/stored_frames.hpp"
#include "core/report/session_numbers.hpp"
#include "core/session/recorder.hpp"
#include "core/session/session.hpp"
#include "tests/core/session/exploration.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/fuzz/entry.hpp"

using namespace dibhr;

namespace {

using Bytes = std::vector<std::uint8_t>;

/// A sound session of an eighth of a second.
Bytes sound_session() {
    const test::SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    test::MovingSurface surface;
    test::Exploration hand(surface);
    {
        test::FeltMovingSurface felt(surface);
        Recorder recorder(folder.file(), *ring, {{"note", "sound"}}, nullptr,
                          std::chrono::steady_clock::now, {&felt});
        recorder.parameters(hand.parameters);
        recorder.media(1, "colour.mp4", "depth.mp4");
        recorder.mark("begin");
        for (int k = 0; k < 125; ++k) test::push(*ring, hand.next());
    }
    std::ifstream stream(folder.file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// What SQL makes of the file, in memory; it may not reach beyond it, nor go on for long.
Bytes changed_by_sql(const Bytes& file, const std::string& sql) {
    sqlite3* opened = nullptr;
    sqlite3_open(":memory:", &opened);
    const std::unique_ptr<sqlite3, int (*)(sqlite3*)> database(opened, sqlite3_close);
    auto* const copy = static_cast<unsigned char*>(sqlite3_malloc64(file.size()));
    std::copy(file.begin(), file.end(), copy);
    const auto bytes = static_cast<sqlite3_int64>(file.size());
    sqlite3_deserialize(opened, "main", copy, bytes, bytes,
                        SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE);
    sqlite3_exec(opened, "PRAGMA journal_mode = MEMORY; PRAGMA max_page_count = 200", nullptr,
                 nullptr, nullptr);
    sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, 2 << 20);
    const auto allow = [](void*, int action, const char* first, const char*, const char*,
                          const char*) {
        const bool leaves = action == SQLITE_ATTACH || action == SQLITE_DETACH;
        const bool tunes = action == SQLITE_PRAGMA &&
                           std::string_view(first) != "writable_schema" &&
                           std::string_view(first) != "user_version";
        return leaves || tunes ? SQLITE_DENY : SQLITE_OK;
    };
    sqlite3_set_authorizer(opened, allow, nullptr);
    sqlite3_progress_handler(
        opened, 100'000, [](void*) { return 1; }, nullptr);
    sqlite3_exec(opened, sql.c_str(), nullptr, nullptr, nullptr);
    sqlite3_int64 size = 0;
    const std::unique_ptr<unsigned char, void (*)(void*)> made(
        sqlite3_serialize(opened, "main", &size, 0), sqlite3_free);
    return made ? Bytes(made.get(), made.get() + size) : file;
}

/// Pieces of the input written over the file: three bytes of place, one of length, the bytes; a
/// length of 255 cuts the file there.
Bytes overwritten(Bytes file, std::span<const std::uint8_t> pieces) {
    while (pieces.size() > 4 && !file.empty()) {
        const std::size_t place =
            (pieces[0] | std::size_t{pieces[1]} << 8U | std::size_t{pieces[2]} << 16U) %
            file.size();
        const std::size_t length = pieces[3];
        pieces = pieces.subspan(4);
        if (length == 255) {
            file.resize(place);
            continue;
        }
        const std::size_t count = std::min({length, pieces.size(), file.size() - place});
        std::copy_n(pieces.begin(), count, file.begin() + static_cast<std::ptrdiff_t>(place));
        pieces = pieces.subspan(count);
    }
    return file;
}

/// Whatever frames it names, it touched this one.
class AnyFrames final : public RecordedFrames {
  public:
    [[nodiscard]] Frame frame(const FrameSource&, double) override { return frame_; }
    [[nodiscard]] std::shared_ptr<const BumpMap> bump(const SessionParameters&) override {
        return nullptr;
    }

  private:
    Frame frame_{test::MovingSurface{}.frame({}, 0.0)};
};

void replay(const Session& session, RecordedSurfaces& frames) {
    SessionReplay replay(session, frames,
                         {{}, [](TouchParameters& touch) { touch.algorithm = Algorithm::pga; }});
    RunComparison comparison;
    while (replay.next()) {
        for (const std::size_t run : {0U, 1U}) {
            const Touch& touch = replay.touch(run);
            test::require_rule(is_finite(touch.sent_force_newton),
                               "a replay sends no force that is not finite");
            comparison.add(replay.recorded(), touch, replay.update_us(run));
        }
    }
    (void)comparison.table_row("any");
}

void read_all(const std::filesystem::path& file) {
    (void)test::is_taken([&file] {
        const Session session(file);
        const std::string warning = session.warning();
        if (!warning.empty()) test::require_one_line(warning);
        (void)test::is_taken([&session] { session.check(); });
        (void)test::is_taken([&session] { (void)hand_ticks(session.reader()); });
        (void)test::is_taken([&session] { (void)numbers_of(session); });
        (void)test::is_taken([&session] {
            static AnyFrames frames;
            replay(session, frames);
        });
        (void)test::is_taken([&session] {
            StoredFrames frames(session, {});
            replay(session, frames);
        });
    });
}

}  // namespace

/// "sql:" and what is done to a sound session, "is:" and the file itself, or pieces written over a
/// sound one.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const test::InputFile file("touch.dibhr");
    static const Bytes sound = sound_session();
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    if (text.starts_with("sql:")) {
        read_all(file.with(changed_by_sql(sound, std::string(text.substr(4)))));
    } else if (text.starts_with("is:")) {
        read_all(file.with({data + 3, size - 3}));
    } else {
        read_all(file.with(overwritten(sound, {data, size})));
    }
    return 0;
}
