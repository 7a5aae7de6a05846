// A damaged session: what can be read is read, and is what was recorded; what is missing is said.
#include <algorithm>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/replay/session_replay.hpp"
#include "core/replay/stored_frames.hpp"
#include "core/session/recorder.hpp"
#include "core/session/session.hpp"
#include "core/session/surface_reader.hpp"
#include "tests/core/session/exploration.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

constexpr int kDamages = DIBHR_SANITIZED ? 6 : 15;  // of each kind

constexpr std::size_t kPage = 16384;

/// A hand over a moving surface, two marks, a change of algorithm, and a note longer than a page.
void record(Recorder& recorder, TickRing& ring, MovingSurface& surface, int ticks) {
    Exploration hand(surface);
    recorder.media(1, "colour.mp4", "depth.mp4");
    recorder.parameters(hand.parameters);
    recorder.mark("begin");
    for (int k = 0; k < ticks; ++k) {
        if (k == ticks / 2) {
            ++hand.parameters.version;
            hand.parameters.touch.algorithm = Algorithm::pga;
            recorder.parameters(hand.parameters);
            recorder.mark("half");
        }
        push(ring, hand.next());
    }
}

SessionFacts facts() {
    return {{"note", std::string(3 * kPage, 'n')}};
}

void record_surface(const std::filesystem::path& file, int ticks) {
    MovingSurface surface;
    FeltMovingSurface felt(surface);
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(file, *ring, facts(), nullptr, std::chrono::steady_clock::now, {&felt});
    record(recorder, *ring, surface, ticks);
}

/// A copy of a session and its log before its recording ended, and of the whole one beside it.
std::filesystem::path copy_unfinished(const SessionFolder& folder, int ticks, bool felt) {
    MovingSurface surface;
    FeltMovingSurface images(surface);
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(folder.file(), *ring, facts(), nullptr, std::chrono::steady_clock::now,
                      {felt ? &images : nullptr});
    record(recorder, *ring, surface, ticks);
    REQUIRE(eventually([&] { return std::cmp_equal(recorder.status().rows, ticks); }));
    const auto copied = folder / "copied.dibhr";
    std::filesystem::copy_file(folder.file(), copied);
    std::filesystem::copy_file(folder.file().string() + "-wal", copied.string() + "-wal");
    recorder.finish();
    return copied;
}

using Cells = std::vector<std::optional<std::string>>;
/// The rows of the view, by their ticks, each value with all its bits.
using Ticks = std::map<std::int64_t, Cells>;

Ticks ticks_of(const SessionReader& reader) {
    Ticks ticks;
    for (Statement row = reader.rows("SELECT tick, * FROM tick ORDER BY tick"); row.next();) {
        Cells cells;
        for (int k = 1; k < row.columns(); ++k) {
            if (!row.has(k))
                cells.emplace_back();
            else if (row.type(k) == Statement::Type::real)
                cells.emplace_back(std::to_string(std::bit_cast<std::uint64_t>(row.real(k))));
            else
                cells.emplace_back(row.text(k));
        }
        ticks[row.integer(0)] = std::move(cells);
    }
    return ticks;
}

/// A value that needs a lost row is missing; no other differs.
bool is_part_of(const Ticks& read, const Ticks& all) {
    return std::ranges::all_of(read, [&all](const auto& row) {
        const auto whole = all.find(row.first);
        if (whole == all.end()) return false;
        for (std::size_t k = 0; k < row.second.size(); ++k)
            if (row.second[k] && row.second[k] != whole->second[k]) return false;
        return true;
    });
}

/// Whether each tile of `part` is stored in `all`, too, with the same levels.
bool is_part_of(const StoredSurface& part, const StoredSurface& all) {
    if (part.felt.images.size() != all.felt.images.size()) return false;
    bool same = true;
    for (std::size_t k = 0; k < all.felt.images.size(); ++k) {
        const DepthImage& one = *part.felt.images[k].levels;
        const DepthImage& other = *all.felt.images[k].levels;
        if (one.columns != other.columns || one.rows != other.rows) return false;
        const auto across = static_cast<std::size_t>(part.tiles.across());
        const auto columns = static_cast<std::size_t>(one.columns);
        part.tiles.visit(part.tiles.all(), [&](std::size_t place) {
            if ((*part.stored[k])[place] == 0) return;
            same = same && (*all.stored[k])[place] != 0;
            for (std::size_t row = 0; row < kTileSide; ++row) {
                const auto first = static_cast<std::ptrdiff_t>(
                    (place / across * kTileSide + row) * columns + place % across * kTileSide);
                same = same && std::equal(one.levels.begin() + first,
                                          one.levels.begin() + first + kTileSide,
                                          other.levels.begin() + first);
            }
        });
    }
    return same;
}

/// The images have whole tiles.
bool is_part_of(SurfaceReader& part, SurfaceReader& all) {
    constexpr std::int64_t kPairs = 200;  // more than there are
    for (std::int64_t pair = 1; part.any() && pair <= kPairs; ++pair)
        if (const auto read = part.surface(pair); read && !is_part_of(*read, *all.surface(pair)))
            return false;
    return true;
}

void require_one_line(const std::string& text, const std::filesystem::path& file) {
    REQUIRE(text.starts_with(file.string() + ": "));
    REQUIRE_FALSE(contains(text, "\n"));
}

/// Replays what is left of the surface, as far as it goes.
void replay(const Session& session) {
    try {
        StoredFrames frames(session, {});
        SessionReplay replay(session, frames, {{}});
        while (replay.next()) continue;
    } catch (const InputError& error) {
        require_one_line(error.what(), session.file());
    }
}

void write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

/// Overwrites pages, which count from 0.
std::string without_pages(std::string bytes, std::size_t first, std::size_t count) {
    bytes.replace(first * kPage, count * kPage, count * kPage, '\0');
    return bytes;
}

/// The pages of a table, by SQLite; those of its leaves or of its branches.
std::vector<std::size_t> pages_of(const std::filesystem::path& file, const std::string& table,
                                  const std::string& kind) {
    std::vector<std::size_t> pages;
    for (const Row& row : query(file, "SELECT pageno FROM dbstat WHERE name = '" + table +
                                          "' AND pagetype = '" + kind + "' ORDER BY pageno"))
        pages.push_back(std::stoul(row[0]) - 1);
    return pages;
}

}  // namespace

TEST_CASE("wherever a session is cut or overwritten what is read of it is what was recorded",
          "[session]") {
    const SessionFolder folder;
    record_surface(folder.file(), 2000);
    const std::string whole = read_text(folder.file());
    const Session recorded(folder.file());
    const Ticks all = ticks_of(recorded.reader());
    SurfaceReader surface(recorded.reader());
    const auto damaged = folder / "damaged.dibhr";
    std::mt19937 random(46);
    const auto below = [&random](std::size_t end) {
        return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
    };
    int read = 0;
    int refused = 0;
    for (int k = 0; k < 2 * kDamages; ++k) {
        std::string bytes = whole;
        if (k % 4 == 0) {
            bytes.resize(below(whole.size()));
        } else {
            for (std::size_t pages = 1 + below(3); pages > 0; --pages) {
                // A page, a part of one, or what a disk writes at once.
                const std::size_t unit = k % 4 == 1 ? kPage : k % 4 == 2 ? 4096 : 512;
                const std::size_t at = below(whole.size() / unit) * unit;
                const bool zero = below(2) == 0;
                for (std::size_t n = at; n < at + unit; ++n)
                    bytes[n] = static_cast<char>(zero ? 0 : random());
            }
        }
        write(damaged, bytes);
        CAPTURE(k);
        try {
            Session session(damaged);
            session.rescue_if_damaged();
            const Ticks ticks = ticks_of(session.reader());
            REQUIRE(is_part_of(ticks, all));
            REQUIRE(std::cmp_equal(session.rows(), ticks.size()));
            if (ticks.size() < all.size()) REQUIRE(contains(session.warning(), "cannot be read"));
            if (session.is_damaged()) require_one_line(session.warning(), damaged);
            SurfaceReader part(session.reader());
            REQUIRE(is_part_of(part, surface));
            replay(session);
            ++read;
        } catch (const InputError& error) {
            require_one_line(error.what(), damaged);
            ++refused;
        }
        REQUIRE(read_text(damaged) == bytes);
    }
    CHECK(3 * read > 2 * 2 * kDamages);
    CHECK(refused > 0);  // files that were cut before their first tick
}

TEST_CASE("ticks of a lost page are a gap of which the times are said", "[session]") {
    const SessionFolder folder;
    record_surface(folder.file(), 2000);
    const Ticks all = [&] { return ticks_of(Session(folder.file()).reader()); }();
    const auto leaves = pages_of(folder.file(), "tick_data", "leaf");
    REQUIRE(leaves.size() > 4);
    const std::string whole = read_text(folder.file());
    write(folder.file(), without_pages(whole, leaves[2], 1));
    Session session(folder.file());
    session.rescue_if_damaged();
    CHECK(is_part_of(ticks_of(session.reader()), all));
    const std::int64_t lost = 2000 - session.rows();
    CHECK(lost > 20);
    CHECK(session.missing() == lost);
    CHECK(contains(session.warning(), ": is damaged: " + std::to_string(lost) +
                                          " of 2000 ticks cannot be read (from "));
    CHECK_THROWS_AS(session.check(), InputError);
    Session::Ticks ticks(session);
    std::int64_t count = 0;
    for (TickRecord tick; ticks.next(tick);) ++count;
    CHECK(count == session.rows());
}

TEST_CASE("no tick is lost with the branches of their tree or with the first page", "[session]") {
    const SessionFolder folder;
    record_surface(folder.file(), 3000);
    const Ticks all = [&] { return ticks_of(Session(folder.file()).reader()); }();
    const std::string whole = read_text(folder.file());
    const auto branches = pages_of(folder.file(), "tick_data", "internal");
    REQUIRE(branches.size() == 1);
    for (const std::size_t page : {branches[0], std::size_t{0}}) {
        write(folder.file(), without_pages(whole, page, 1));
        Session session(folder.file());
        session.rescue_if_damaged();
        CHECK(ticks_of(session.reader()) == all);
        CHECK(contains(session.warning(), "is damaged: no tick is lost"));
        CHECK(session.fact("note") == facts()["note"]);
        CHECK(session.marks().size() == 2);
    }
}

TEST_CASE("a session whose frames or settings are lost is exported, and no tick of them replayed",
          "[session]") {
    const SessionFolder folder;
    record_surface(folder.file(), 1000);
    const std::string table = GENERATE(as<std::string>{}, "parameters", "pair", "source");
    const auto leaves = pages_of(folder.file(), table, "leaf");
    const Ticks all = [&] { return ticks_of(Session(folder.file()).reader()); }();
    write(folder.file(), without_pages(read_text(folder.file()), leaves.at(0), 1));
    Session session(folder.file());
    session.rescue_if_damaged();
    const Ticks ticks = ticks_of(session.reader());
    CHECK(ticks.size() == all.size());
    CHECK(is_part_of(ticks, all));
    CHECK(contains(session.warning(), "not all can be read of its "));
    Session::Ticks computed(session);
    TickRecord tick;
    CHECK_FALSE(computed.next(tick));
}

TEST_CASE("more than two seconds behind a torn page in the log of a broken recording are read",
          "[session]") {
    constexpr int kTicks = 5000;
    constexpr int kUnflushed = 2000;
    constexpr int kOfPages = 100;  // in the torn ones
    const SessionFolder folder;
    const bool felt = GENERATE(false, true);
    const auto copied = copy_unfinished(folder, kTicks, felt);
    const auto log = std::filesystem::path(copied.string() + "-wal");
    const Session recorded(folder.file());
    SurfaceReader surface(recorded.reader());
    const Ticks all = [&] { return ticks_of(Session(copied).reader()); }();
    REQUIRE(all.size() == kTicks);
    const std::string whole = read_text(log);
    std::mt19937 random(7);
    for (int k = 0; k < kDamages; ++k) {
        std::string bytes = whole;
        // Without its last page nothing is left of the last transaction, which may be the only one.
        const std::size_t at =
            std::uniform_int_distribution<std::size_t>(0, whole.size() - 2 * kPage)(random);
        if (k % 3 == 0)
            bytes.resize(at);
        else
            for (std::size_t n = at; n < std::min(at + 512, bytes.size()); ++n)
                bytes[n] = static_cast<char>(random());
        write(log, bytes);
        CAPTURE(k, at, felt);
        try {
            Session session(copied);
            session.rescue_if_damaged();
            const Ticks ticks = ticks_of(session.reader());
            REQUIRE(is_part_of(ticks, all));
            if (session.is_damaged() && ticks.size() < all.size())
                REQUIRE(contains(session.warning(), "cannot be read"));
            SurfaceReader part(session.reader());
            REQUIRE(is_part_of(part, surface));
            replay(session);
            // Behind a cut nothing is left.
            if (k % 3 != 0) REQUIRE(ticks.size() > kTicks - kUnflushed - kOfPages);
        } catch (const InputError& error) {
            require_one_line(error.what(), copied);
        }
    }
    write(log, whole);
    Session session(copied);
    session.rescue_if_damaged();
    CHECK_FALSE(session.is_damaged());
    CHECK(session.rows() == kTicks);
}

TEST_CASE("a frame of the log with the number of a page that cannot be costs that page only",
          "[session]") {
    constexpr int kTicks = 5000;
    constexpr std::size_t kFrame = kPage + 24;
    const SessionFolder folder;
    const auto copied = copy_unfinished(folder, kTicks, false);
    const auto log = std::filesystem::path(copied.string() + "-wal");
    const Ticks all = [&] { return ticks_of(Session(copied).reader()); }();
    std::string bytes = read_text(log);
    const std::size_t frame = 32 + (bytes.size() / kFrame / 4) * kFrame;
    bytes[frame] = static_cast<char>(bytes[frame] ^ 0x80);
    write(log, bytes);
    Session session(copied);
    session.rescue_if_damaged();
    REQUIRE(session.is_damaged());
    const Ticks ticks = ticks_of(session.reader());
    CHECK(is_part_of(ticks, all));
    CHECK(ticks.size() + 200 > all.size());
}

TEST_CASE("where an older version of a page is taken its ticks are found or said to be lost",
          "[session]") {
    constexpr std::size_t kFrame = kPage + 24;
    const SessionFolder folder;
    const auto copied = copy_unfinished(folder, 5000, false);
    const auto log = std::filesystem::path(copied.string() + "-wal");
    const Ticks all = [&] { return ticks_of(Session(copied).reader()); }();
    const std::string root =
        answer(folder.file(), "SELECT rootpage FROM sqlite_master WHERE name = 'tick_data'");
    std::string bytes = read_text(log);
    for (std::size_t frame = 32; frame + kFrame <= bytes.size(); frame += kFrame)
        if (static_cast<unsigned char>(bytes[frame + 3]) == std::stoul(root) &&
            bytes[frame + 2] == 0)
            bytes.replace(frame + 24, kPage, kPage, 'x');
    write(log, bytes);
    Session session(copied);
    session.rescue_if_damaged();
    REQUIRE(session.is_damaged());
    CHECK(ticks_of(session.reader()) == all);
    CHECK(contains(session.warning(), "cannot be read (from "));
}

TEST_CASE("a table whose statement is damaged is read by this schema's and no query is run",
          "[session]") {
    const SessionFolder folder;
    record_surface(folder.file(), 500);
    const std::string sql =
        GENERATE(as<std::string>{}, "CREATE TABLE mark(id INTEGER PRIMARY KEX, ",
                 "CREATE TABLE mark AS SELECT 1 AS id, 2 AS t", "CREATE VIEW m");
    REQUIRE(change(folder.file(), "PRAGMA writable_schema = ON; UPDATE sqlite_master SET sql = '" +
                                      sql + "' WHERE name = 'mark'"));
    Session session(folder.file());
    session.rescue_if_damaged();
    REQUIRE(session.is_damaged());
    CHECK(session.rows() == 500);
    CHECK(session.marks().size() == 2);
    CHECK(contains(session.warning(), "not all can be read of its marks"));
}

TEST_CASE("a session with another view of its ticks is read as its format codes them",
          "[session]") {
    const SessionFolder folder;
    record_surface(folder.file(), 500);
    const Ticks all = [&] { return ticks_of(Session(folder.file()).reader()); }();
    const std::string sql = GENERATE(
        as<std::string>{}, "DROP VIEW tick",
        "DROP VIEW tick; CREATE VIEW tick AS SELECT * FROM tick_data",
        "DROP VIEW tick; CREATE VIEW tick AS WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + "
        "1 "
        "FROM c) SELECT x AS t, x AS tick FROM c",
        "PRAGMA writable_schema = ON; UPDATE sqlite_master SET sql = replace(sql, 'gx', 'gy') "
        "WHERE name = 'tick'");
    REQUIRE(change(folder.file(), sql));
    Session session(folder.file());
    session.rescue_if_damaged();
    CHECK(ticks_of(session.reader()) == all);
    CHECK(contains(session.warning(), "has a damaged view of its ticks"));
}

TEST_CASE("of a damaged session numbers that no recording reaches are refused in one line",
          "[session]") {
    const SessionFolder folder;
    record_surface(folder.file(), 500);
    const std::size_t page = pages_of(folder.file(), "mark", "leaf").at(0);
    REQUIRE(change(folder.file(),
                   "UPDATE tick_data SET tick = 9223372036854775807 WHERE tick = 9;"
                   "UPDATE tick_data SET tick = -9223372036854775807 WHERE tick = 8;"
                   "UPDATE clock SET dropped = 9223372036854775807"));
    write(folder.file(), without_pages(read_text(folder.file()), page, 1));
    try {
        Session session(folder.file());
        session.rescue_if_damaged();
        FAIL("nothing is refused");
    } catch (const InputError& error) {
        require_one_line(error.what(), folder.file());
    }
}

TEST_CASE("a large file that is no database is refused by its begin", "[session]") {
    const SessionFolder folder;
    write(folder.file(), "no database");
    std::filesystem::resize_file(folder.file(), std::uintmax_t{1} << 38U);
    try {
        const Session session(folder.file());
        FAIL("it is not refused");
    } catch (const InputError& error) {
        CHECK(contains(error.what(), "no SQLite file"));
    }
}

TEST_CASE("a damaged session is refused where it is not to be rescued", "[session]") {
    const SessionFolder folder;
    record_surface(folder.file(), 500);
    CHECK(Session(folder.file(), IfDamaged::refuse).rows() == 500);
    const std::string whole = read_text(folder.file());
    const std::string damaged = GENERATE_COPY(
        whole.substr(0, whole.size() / 2), without_pages(whole, 0, 1), without_pages(whole, 1, 3));
    write(folder.file(), damaged);
    CHECK_THROWS_AS(Session(folder.file(), IfDamaged::refuse), DamagedSession);
}
