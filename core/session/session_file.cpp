// A session file open for writing: filled tick by tick, within transactions.
#include "core/session/session_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <ctime>
#include <string_view>

#include "core/error.hpp"
#include "core/files/machine.hpp"
#include "core/files/utc_text.hpp"
#include "core/files/write_failure.hpp"
#include "core/haptics/surface.hpp"

namespace dibhr {

namespace {

// A version that is lowered to other limits gets a number that no window uses: 2^32 more.
constexpr int kHeldAgainShift = 32;
// A reader takes no larger value at once.
constexpr std::size_t kMostMapBytes = std::size_t{1} << 19;
// Large pages waste little at their ends.
constexpr const char* kFileLayout = "PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 0";
constexpr const char* kFlush = "PRAGMA synchronous = NORMAL";  // also for the merge at closing

/// Makes an empty file where there was none; never touches an existing file.
const std::filesystem::path& made(const std::filesystem::path& file) {
    const int descriptor = open(file.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
        close(descriptor);
        return file;
    }
    if (errno == EEXIST)
        throw InputError(file.string() + ": exists already; choose another name for the session");
    throw InputError(file.string() + ": " +
                     write_failure(errno, "the session cannot be recorded there"));
}

/// A new session file with its tables, in write-ahead mode: readers do not stop the recording.
Database made_database(const std::filesystem::path& file) {
    Database database(made(file));
    database.execute("PRAGMA page_size = " + std::to_string(kSessionPageBytes));
    database.execute(kFileLayout);
    database.execute("BEGIN");
    database.execute(session_schema());
    database.execute("COMMIT");
    return database;
}

/// For a row with all the columns of that table.
std::string insertion(const std::string& into, int columns) {
    std::string marks = "?";
    for (int k = 1; k < columns; ++k) marks += ", ?";
    return "INSERT " + into + " VALUES (" + marks + ")";
}

std::string insert_parameters() {
    int columns = 4;  // version, first_tick, force_enabled, bump
    columns += static_cast<int>(touch_choices().size() + touch_switches().size());
    SessionParameters parameters;
    visit_numbers(parameters, [&columns](std::string_view, double) { ++columns; });
    return insertion("OR IGNORE INTO parameters", columns);
}

/// Facts of the machine that records; unknown ones are left out.
SessionFacts machine_facts() {
    const Machine machine = this_machine();
    SessionFacts facts;
    const auto add = [&facts](const char* key, const std::string& value) {
        if (!value.empty()) facts[key] = value;
    };
    add("machine-cpu", machine.cpu);
    add("machine-system", machine.system);
    add("machine-kernel", machine.kernel);
    return facts;
}

std::int64_t state_of(const TickRecord& record) {
    namespace at = tick_state;
    constexpr auto kLast = static_cast<std::uint8_t>(kLastPrimitiveKind);
    const auto bit = [](bool set, int shift) { return std::int64_t{set ? 1 : 0} << shift; };
    const std::int64_t primitive = record.primitive > kLast ? 0 : record.primitive;
    return bit(record.contact, at::kContact) | primitive << at::kPrimitive |
           std::int64_t{record.buttons} << at::kButtons | bit(!record.surface, at::kNoSurface) |
           bit(!record.device_ready, at::kNotReady) |
           bit(record.mouse_fallback, at::kMouseFallback) | bit(record.from_zero, at::kFromZero) |
           bit(record.releases_contact, at::kReleasesContact) |
           bit(record.goal_refused, at::kRefused) | std::int64_t{record.cut} << at::kCut |
           bit(record.catching_up, at::kCatchingUp) | bit(record.gliding, at::kGliding) |
           bit(record.standstill, at::kStandstill) | bit(record.motion_unknown, at::kMotionUnknown);
}

/// A time in whole nanoseconds (`nanoseconds` a unit); nothing where they give other bits.
std::optional<std::int64_t> whole_nanoseconds(double value, double nanoseconds) noexcept {
    constexpr double kMost = 9e15;  // beyond, a real has no whole nanoseconds
    const double count = std::round(value * nanoseconds);
    const auto whole = std::abs(count) < kMost ? static_cast<std::int64_t>(count) : 0;
    if (!same_bits(static_cast<double>(whole) / nanoseconds, value)) return std::nullopt;
    return whole;
}

void bind_time(Statement& row, double value, double nanoseconds) noexcept {
    const auto whole = whole_nanoseconds(value, nanoseconds);
    whole ? row.bind(*whole) : row.bind(SqlReal{value});
}

/// The pixel of a place; a place beyond all pictures has none.
std::optional<std::int64_t> pixel_of(double place_px) noexcept {
    constexpr double kMost = 1e9;
    if (!(std::abs(place_px) < kMost)) return std::nullopt;
    return static_cast<std::int64_t>(place_px);
}

/// How far a force sent is off the direction of the force wanted, along one axis, in whole parts of
/// a newton; nothing where these do not give its bits again. `shortening` is by how much z is
/// shorter.
std::optional<std::int64_t> off_direction(double sent, double wanted, double shortening) noexcept {
    constexpr double kMost = 2147483648.0;  // in four bytes instead of eight
    constexpr auto kParts = static_cast<double>(kPartsPerNewton);
    const double straight = wanted * shortening;
    const double off = (sent - straight) * kParts;
    if (!(std::abs(off) < kMost)) return std::nullopt;
    const auto whole = static_cast<std::int64_t>(off);
    if (!same_bits(straight + static_cast<double>(whole) / kParts, sent)) return std::nullopt;
    return whole;
}

}  // namespace

SessionFile::SessionFile(const std::filesystem::path& file, const SessionFacts& facts,
                         const RecordedSurface& surface) try
    : path_(file),
      database_(made_database(file)),
      insert_tick_(database_, insertion("INTO tick_data", kTickDataColumns)),
      insert_pair_(database_, "INSERT INTO pair VALUES (?, ?, ?, ?, ?, ?, ?)"),
      insert_fact_(database_, "INSERT OR REPLACE INTO session VALUES (?, ?)"),
      place_(place_of(file)) {
    if (surface.surfaces != nullptr && surface.how != SurfaceRecording::off)
        surface_.emplace(database_, *surface.surfaces, surface.how);
    begin();
    for (const auto& [key, value] : machine_facts()) set_fact(key, value);
    set_fact("started", utc_text(static_cast<double>(std::time(nullptr))));
    for (const auto& [key, value] : facts) set_fact(key, value);
    set_fact("schema_version", std::to_string(kSessionSchemaVersion));
    set_fact("units", "pixels of the depth image, newtons, seconds; see table tick_column");
    set_fact("record-surface",
             std::string(name_of(surface_ ? surface.how : SurfaceRecording::off)));
    set_fact("complete", "0");
    commit();
    merge_log();  // a copy without the log is still recognised as a session
    keeper_ = std::make_unique<LogKeeper>(file);
} catch (const DatabaseError& error) {
    remove_database(file);
    throw InputError(file.string() + ": the session cannot be recorded there (" + error.what() +
                     "); choose another disk");
}

SessionFile::~SessionFile() {
    keeper_.reset();
    try_to("ROLLBACK");
    try_to(kFlush);
}

void SessionFile::begin() {
    if (keeper_)
        keeper_->begin(database_);
    else
        database_.execute("BEGIN");
}

void SessionFile::add(const TickRecord& record) {
    if (version_ != record.settings || limits_ != record.limits) use_settings(record);
    if (record.surface && (pair_ != record.frames || (surface_ && mark_ != record.mark)))
        add_pair(record);
    if (surface_) surface_->add(record, parameters_, bump_.get());
    Statement& row = insert_tick_;
    row.bind(record.tick);
    add_times(record);
    row.bind(std::isfinite(record.update_us)
                 ? std::llround(record.update_us * kNanosecondsPerMicrosecond)
                 : -1);
    row.bind(state_of(record), record.surface ? std::optional(pairs_) : std::nullopt, record.blend,
             parameters_row_, record.moves);
    row.bind_unless(record.i, pixel_of(record.proxy.x));
    row.bind_unless(record.j, pixel_of(record.proxy.y));
    for (int axis = 0; axis < 3; ++axis) row.bind(record.goal[axis]);
    for (int axis = 0; axis < 3; ++axis) row.bind_unless(record.proxy[axis], record.goal[axis]);
    add_forces(record);
    row.run();
}

/// The time since the tick before mostly follows from that tick's row, and is then NULL.
void SessionFile::add_times(const TickRecord& record) {
    const auto t_ns = whole_nanoseconds(record.t_s, kNanosecondsPerSecond);
    const bool goes_on = t_ns && last_t_ns_ && last_tick_ == record.tick - 1;
    bind_time(insert_tick_, record.t_s, kNanosecondsPerSecond);
    if (goes_on &&
        same_bits(static_cast<double>(*t_ns - *last_t_ns_) / kNanosecondsPerSecond, record.dt_s)) {
        insert_tick_.bind(std::nullopt);
    } else {
        bind_time(insert_tick_, record.dt_s, kNanosecondsPerSecond);
    }
    bind_time(insert_tick_, record.lateness_us, kNanosecondsPerMicrosecond);
    last_tick_ = record.tick;
    last_t_ns_ = t_ns;
}

/// In the form that the view reads. This file is compiled without fused operations: products and
/// sums are rounded one by one, as in SQLite.
void SessionFile::add_forces(const TickRecord& record) {
    Statement& row = insert_tick_;
    const Vec3 wanted = record.spring_newton + record.own_newton;
    for (int axis = 0; axis < 3; ++axis) {
        const double follows =
            newton_per_px_.value_or(std::nan("")) * (record.proxy[axis] - record.goal[axis]);
        row.bind_unless(record.spring_newton[axis], follows);
    }
    const auto follows = [&](int axis) { return record.cut == 0 ? wanted[axis] : 0.0; };
    const double shortening = record.sent_newton.z / wanted.z;
    for (int axis = 0; axis < 2; ++axis) {
        const double sent = record.sent_newton[axis];
        const auto off = off_direction(sent, wanted[axis], shortening);
        if (off || same_bits(sent, follows(axis))) {
            row.bind(same_bits(sent, follows(axis)) ? std::nullopt : off);
        } else {
            row.bind(SqlReal{sent});
        }
    }
    row.bind_unless(record.sent_newton.z, follows(2));
    for (int axis = 0; axis < 3; ++axis) row.bind_unless(record.own_newton[axis], 0.0);
}

void SessionFile::commit() {
    if (surface_) surface_->flush();
    database_.execute("COMMIT");
    const Place now = place_of(path_);
    if (now == Place{}) throw DatabaseError("the file is gone from its place");
    if (now != place_) throw DatabaseError("another file is in its place");
}

void SessionFile::register_parameters(const SessionParameters& parameters,
                                      const std::shared_ptr<const BumpMap>& bump) {
    known_parameters_[parameters.version] = parameters;
    if (surface_ && bump && !parameters.bump.file.empty())
        known_bumps_[parameters.bump.file] = bump;
}

void SessionFile::register_media(std::uint32_t number, const std::filesystem::path& colour,
                                 const std::filesystem::path& depth,
                                 const std::string& depth_meaning, bool grows) {
    known_media_[number] = {colour, depth, depth_meaning, grows};
}

void SessionFile::complete_media(const std::vector<SessionMedia>& contents) {
    for (auto& [number, files] : known_media_) files.grows = false;
    for (const SessionMedia& content : contents) known_contents_[content.file] = content;
    for (const std::filesystem::path& file : std::exchange(growing_files_, {})) complete_file(file);
}

void SessionFile::complete_file(const std::filesystem::path& file) {
    const auto known = known_contents_.find(file);
    if (known == known_contents_.end())
        new_files_.push_back(file);
    else
        set_content(known->second);
}

void SessionFile::add_maps(std::uint32_t version, const std::vector<SessionMap>& maps) {
    Statement insert(database_, "INSERT OR IGNORE INTO touch_map VALUES (?, ?, ?, ?, ?, ?)");
    for (const SessionMap& map : maps) {
        const std::string_view png = map.png;
        for (std::size_t at = 0, part = 0; at < png.size(); at += kMostMapBytes, ++part) {
            insert.run(version, map.kind, part, map.lowest, map.highest,
                       SqlBytes{png.substr(at, kMostMapBytes)});
        }
    }
}

void SessionFile::set_fact(const std::string& key, const std::string& value) {
    insert_fact_.run(key, value);
}

void SessionFile::add_mark(const SessionMark& mark) {
    Statement(database_, "INSERT INTO mark(t, tag, text) VALUES (?, ?, ?)")
        .run(mark.t_s, mark.tag, mark.text);
}

void SessionFile::add_clock(std::int64_t t_ns, double utc_s, std::uint64_t dropped,
                            std::uint64_t high_water) {
    Statement(database_, "INSERT OR REPLACE INTO clock VALUES (?, ?, ?, ?)")
        .run(t_ns, utc_s, dropped, high_water);
}

/// The parameters of the tick's force: the registered ones, lowered to the limits of its device.
void SessionFile::use_settings(const TickRecord& record) {
    version_ = parameters_row_ = record.settings;
    limits_ = record.limits;
    newton_per_px_.reset();
    parameters_ = nullptr;
    const auto known = known_parameters_.find(record.settings);
    if (known == known_parameters_.end()) return;
    SessionParameters held = known->second;
    held.first_tick = record.tick;
    if (limits_) {
        held.touch.coupling = held_coupling(held.touch.coupling, *limits_);
        held.limits = held_limits(held.limits, *limits_);
    }
    // As in coupling_force() and the view: bit by bit the same.
    newton_per_px_ =
        held.touch.coupling.stiffness_newton_per_mm * held.touch.coupling.pixel_pitch_mm;
    auto& written = held_parameters_[record.settings];
    const auto same = std::find_if(written.begin(), written.end(), [&held](const auto& other) {
        return other.touch == held.touch && other.limits == held.limits;
    });
    if (same == written.end()) {
        held.version += std::uint64_t{written.size()} << kHeldAgainShift;
        add_parameters(held);
        parameters_ = &written.emplace_back(held);
    } else {
        parameters_ = &*same;
    }
    parameters_row_ = parameters_->version;
    if (surface_) use_bump(held.bump.file);
}

void SessionFile::add_parameters(SessionParameters parameters) {
    Statement insert(database_, insert_parameters());
    insert.bind(parameters.version, parameters.first_tick);
    for (const TouchChoice& choice : touch_choices()) insert.bind(choice.of(parameters.touch));
    visit_numbers(parameters, [&insert](std::string_view, double number) { insert.bind(number); });
    insert.bind(parameters.force_enabled, media_row(parameters.bump.file));
    for (const TouchSwitch& entry : touch_switches()) insert.bind(entry.of(parameters.touch));
    insert.run();
}

/// The map of that file under the next ticks; written once.
void SessionFile::use_bump(const std::filesystem::path& file) {
    const auto known = known_bumps_.find(file);
    bump_ = known == known_bumps_.end() ? nullptr : known->second;
    if (bump_) surface_->add_bump(media_row(file).value(), bump_);
}

void SessionFile::add_pair(const TickRecord& record) {
    const FramePair& frames = record.frames;
    const std::int64_t source = source_row(frames.source, record.tick);
    insert_pair_.run(++pairs_, source, frames.from_frame, frames.to_frame, frames.from_s,
                     frames.to_s, frames.span_s);
    pair_ = frames;
    mark_ = record.mark;
    if (surface_) surface_->begin(pairs_, record);
}

std::int64_t SessionFile::source_row(const FrameSource& source, std::int64_t tick) {
    const auto found = std::find(sources_.begin(), sources_.end(), source);
    if (found != sources_.end()) return found - sources_.begin() + 1;
    sources_.push_back(source);
    const auto id = static_cast<std::int64_t>(sources_.size());
    const MediaFiles files = known_media_[source.media];
    const auto colour = media_row(files.colour, files.grows),
               depth = media_row(files.depth, files.grows);
    int columns = 6;  // id, first_tick, media, colour, depth, depth_meaning
    visit_cleaning(source, [&columns](std::string_view, const auto&) { ++columns; });
    Statement insert(database_, insertion("INTO source", columns));
    insert.bind(id, tick, source.media, colour, depth, files.depth_meaning);
    visit_cleaning(source, [&insert](std::string_view, const auto& fact) { insert.bind(fact); });
    insert.run();
    return id;
}

std::optional<std::int64_t> SessionFile::media_row(const std::filesystem::path& file, bool grows) {
    if (file.empty()) return std::nullopt;
    const auto found = media_rows_.find(file);
    if (found != media_rows_.end()) return found->second;
    const auto id = static_cast<std::int64_t>(media_rows_.size()) + 1;
    Statement(database_, "INSERT INTO media(id, file) VALUES (?, ?)").run(id, file.string());
    media_rows_.emplace(file, id);
    if (grows)
        growing_files_.push_back(file);
    else
        complete_file(file);
    return id;
}

std::vector<std::filesystem::path> SessionFile::take_new_files() {
    return std::exchange(new_files_, {});
}

void SessionFile::set_content(const SessionMedia& content) {
    Statement(database_, "UPDATE media SET bytes = ?, sha256 = ?, head_bytes = ? WHERE file = ?")
        .run(content.bytes, content.sha256, content.head_bytes, content.file.string());
}

void SessionFile::merge_log() {
    keeper_.reset();
    database_.execute(kFlush);
    database_.execute("PRAGMA wal_checkpoint(TRUNCATE)");
}

void SessionFile::end_log() noexcept {
    // After a power cut a journal in a file would have to be rolled back, which no reader does.
    try_to("PRAGMA journal_mode = MEMORY");
}

/// For statements that may fail: the file is complete without them, and readable with its log.
void SessionFile::try_to(const char* sql) noexcept {
    try {
        database_.execute(sql);
    } catch (const DatabaseError&) {
    }
}

std::uint64_t SessionFile::bytes() const {
    return database_bytes(path_);
}

std::uint64_t SessionFile::bytes_recorded() {
    return static_cast<std::uint64_t>(database_.number("PRAGMA page_count")) *
           static_cast<std::uint64_t>(database_.number("PRAGMA page_size"));
}

SessionFile::Place SessionFile::place_of(const std::filesystem::path& file) {
    struct stat found {};
    if (stat(file.c_str(), &found) != 0) return {};
    return {static_cast<std::uint64_t>(found.st_dev), static_cast<std::uint64_t>(found.st_ino)};
}

}  // namespace dibhr
