// A recorded session, open for reading.
#include "core/session/session.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <set>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/surface.hpp"
#include "core/session/session_schema.hpp"

namespace dibhr {

namespace {

/// The columns of a table. A file older than a column lacks it: its value is then the default.
std::set<std::string> columns_of(const SessionReader& reader, const std::string& table) {
    std::set<std::string> columns;
    Statement query = reader.rows("SELECT name FROM pragma_table_info('" + table + "')");
    while (query.next()) columns.insert(query.text(0));
    return columns;
}

PrimitiveKind primitive_named(const std::string& name) {
    for (int k = 0; k <= static_cast<int>(kLastPrimitiveKind); ++k) {
        const auto kind = static_cast<PrimitiveKind>(k);
        if (name == name_of(kind)) return kind;
    }
    return PrimitiveKind::none;
}

/// Refuses numbers that nobody could set and no proxy can walk with. Spring and damper may have any
/// value: the safety stage limits their force.
void require_in_range(const TouchParameters& touch, const std::filesystem::path& file) {
    for (const TouchNumber& number : touch_numbers()) {
        if (number.topic == TouchTopic::spring || number.topic == TouchTopic::damper) continue;
        const double value = number.of(touch);
        if (value >= number.lowest && value <= number.highest) continue;
        throw InputError(file.string() + ": is damaged (" + std::string(number.column) + " is " +
                         short_text(value) + ", not " + short_text(number.lowest) + " to " +
                         short_text(number.highest) + "); copy it again");
    }
}

/// Throws InputError for a name of a later version.
void set_choice(const std::string& word, const TouchChoice& choice, TouchParameters& touch,
                const std::filesystem::path& file) {
    if (choice.choose(word, touch)) return;
    throw InputError(file.string() + ": was recorded with " + std::string(choice.noun) + ' ' +
                     in_quotes(word) + " that is not known here; update dibhr");
}

/// Refuses dynamics that are not finite, or negative.
void require_device(const DeviceDynamics& watched, const std::filesystem::path& file) {
    DeviceLimits device;
    device.dynamics = watched;
    if (usable(device).dynamics == watched) return;
    throw InputError(file.string() +
                     ": is damaged (what it says of the watched device cannot be); copy it again");
}

/// Takes the columns of a row one after the other.
class Row {
  public:
    explicit Row(const Statement& query) : query_(query) {}

    template <typename... Values>
    void take(Values&... values) {
        (take_one(values), ...);
    }

    double real() { return query_.real(column_++); }
    std::int64_t integer() { return query_.integer(column_++); }
    bool flag() { return integer() != 0; }
    std::string text() { return query_.text(column_++); }

  private:
    template <std::integral Integer>
    void take_one(Integer& value) {
        value = static_cast<Integer>(integer());
    }
    void take_one(bool& value) { value = flag(); }
    void take_one(double& value) { value = real(); }
    void take_one(std::string& value) { value = text(); }
    void take_one(Vec3& value) { take(value.x, value.y, value.z); }
    void take_one(FrameSource& source) {
        take(source.media);
        visit_cleaning(source, [this](std::string_view, auto& fact) { take(fact); });
    }
    void take_one(SessionMedia& media) {
        media.file = text();
        take(media.bytes, media.sha256, media.head_bytes);
    }

    const Statement& query_;
    int column_{0};
};

/// The columns of a SessionMedia; `media`: the alias of the table `media` in the query.
std::string media_columns(const SessionReader& reader, const std::string& media) {
    const bool has_head = columns_of(reader, "media").contains("head_bytes");
    return media + ".file, " + media + ".bytes, " + media + ".sha256, " +
           (has_head ? media + ".head_bytes" : "0");
}

/// The columns of a FrameSource; `s` is the table `source`.
std::string source_columns(const SessionReader& reader) {
    const std::set<std::string> columns = columns_of(reader, "source");
    std::string text = "s.media";
    FrameSource source;
    visit_cleaning(source, [&](std::string_view name, const auto&) {
        text += columns.contains(std::string(name)) ? ", s." + std::string(name) : ", 0";
    });
    return text;
}

// In the order in which Ticks::next takes them; after them the columns of the source, and then:
constexpr const char* kTickQueryBegin =
    "SELECT t.tick, t.t, t.dt_s, t.lateness_us, t.ns, t.settings, ";
constexpr const char* kTickQueryEnd =
    ", t.frame, t.to_frame, q.from_s, q.to_s, q.span_s, t.pair, t.blend, t.utc_s, t.video_s, "
    "t.gx, t.gy, t.gz, t.px, t.py, t.pz, t.fx, t.fy, t.fz, t.cx, t.cy, t.cz, t.ox, t.oy, t.oz, "
    "t.moves, t.i, t.j, t.contact, t.primitive, t.buttons, t.cut, "
    "t.surface, t.ready, t.stand_in, t.restart, t.lets_go, t.refused, "
    "(SELECT d.state >> 20 FROM tick_data d WHERE d.tick = t.tick) "
    "FROM tick t LEFT JOIN pair q ON q.id = t.pair LEFT JOIN source s ON s.id = q.source WHERE "
    "t.tick >= ";
static_assert(tick_state::kCatchingUp == 20 && tick_state::kGliding == 21 &&
              tick_state::kStandstill == 22 && tick_state::kMotionUnknown == 23);

/// `damaged`: ticks whose settings or frames are lost are passed over. (The first schema has none.)
std::string ticks_from(const SessionReader& reader, std::int64_t tick, bool damaged) {
    return kTickQueryBegin + source_columns(reader) + kTickQueryEnd + std::to_string(tick) +
           (damaged ? " AND t.fx IS NOT NULL AND NOT (t.surface AND t.settings IS NOT NULL AND "
                      "s.id IS NULL)"
                    : "") +
           " ORDER BY t.tick";
}

}  // namespace

Session::Session(const std::filesystem::path& file, IfDamaged if_damaged)
    : reader_(file, if_damaged) {
    try {
        read();
    } catch (const InputError&) {
        if (if_damaged == IfDamaged::refuse || reader_.is_rescued() || !reader_.rescue_if_damaged())
            throw;
        read();
    }
}

void Session::rescue_if_damaged() {
    if (!reader_.is_rescued() && reader_.rescue_if_damaged()) read();
}

void Session::read() {
    facts_.clear();
    parameters_.clear();
    sources_.clear();
    marks_.clear();
    kept_bytes_ = 0;
    read_facts();
    read_parameters();
    read_sources();
    read_marks();
    read_extent();
}

std::string Session::fact(const std::string& key) const {
    const auto found = facts_.find(key);
    return found == facts_.end() ? std::string{} : found->second;
}

std::string Session::warning() const {
    std::string text = is_damaged() ? damage_warning() : log_warning();
    for (const std::string& more : {missing_surfaces_warning(), reader_.other_schema()})
        if (!more.empty()) text += (text.empty() ? file().string() + ": " : "; it ") + more;
    return text;
}

std::string Session::missing_surfaces_warning() const {
    const std::string missing = fact("missing_surfaces");
    if (missing.empty() || missing == "0") return {};
    return "lacks the surface of " + missing +
           " pairs of frames, which could not be stored in time; a replay of these needs the video";
}

std::string Session::damage_warning() const {
    const std::string loss = fact(kDamageFact);
    return file().string() + ": " +
           (reader_.is_rescued() ? reader_.damage() : "is of a recording that was damaged") + ": " +
           loss + (reader_.is_rescued() ? "; copy it again" : "");
}

std::string Session::log_warning() const {
    const std::string log = file().filename().string() + "-wal";
    if (reader_.log() == SessionReader::Log::foreign)
        return file().string() + ": its recording ended, so " + log +
               " beside it belongs to another one and is not read; move it away";
    // The log may also have been merged by another program.
    if (reader_.log() != SessionReader::Log::absent || fact("complete") != "0") return {};
    return file().string() + ": its recording was broken off, and its last moments may be in " +
           log + ", which is not here; copy both files";
}

const SessionParameters* Session::parameters_of(std::uint64_t version) const noexcept {
    const auto found = std::ranges::find(parameters_, version, &SessionParameters::version);
    return found == parameters_.end() ? nullptr : &*found;
}

const SessionSource* Session::source_of(const FrameSource& source) const noexcept {
    const auto found = std::ranges::find(sources_, source, &SessionSource::source);
    return found == sources_.end() ? nullptr : &*found;
}

void Session::read_facts() {
    Statement query = reader_.rows("SELECT key, value FROM session");
    while (query.next()) {
        const std::string key = query.text(0);
        std::string value = query.text(1);
        keep(key.size() + value.size());
        facts_[key] = std::move(value);
    }
}

void Session::read_parameters() {
    const std::set<std::string> columns = columns_of(reader_, "parameters");
    const auto has = [&columns](std::string_view column) {
        return columns.contains(std::string(column));
    };
    std::string question =
        "SELECT version, first_tick, force_enabled, " + media_columns(reader_, "m");
    const auto add = [&question](std::string_view column) {
        question += ", " + std::string(column);
    };
    const auto is_read = [&has](const TouchChoice& choice) {
        return choice.in_every_session || has(choice.column);
    };
    for (const TouchChoice& choice : touch_choices())
        if (is_read(choice)) add(choice.column);
    for (const TouchSwitch& entry : touch_switches())
        if (has(entry.column)) add(entry.column);
    SessionParameters standard;
    visit_numbers(standard, [&](std::string_view column, double) {
        if (has(column)) add(column);
    });
    Statement query = reader_.rows(
        question + " FROM parameters LEFT JOIN media m ON m.id = bump ORDER BY first_tick");
    while (query.next()) {
        Row row(query);
        SessionParameters parameters;
        row.take(parameters.version, parameters.first_tick, parameters.force_enabled,
                 parameters.bump);
        for (const TouchChoice& choice : touch_choices())
            if (is_read(choice)) set_choice(row.text(), choice, parameters.touch, file());
        for (const TouchSwitch& entry : touch_switches())
            if (has(entry.column)) row.take(entry.in(parameters.touch));
        visit_numbers(parameters, [&](std::string_view column, double& number) {
            if (has(column)) number = row.real();
        });
        require_in_range(parameters.touch, file());
        require_device(parameters.limits.watched, file());
        keep(sizeof parameters + parameters.bump.file.native().size());
        parameters_.push_back(std::move(parameters));
    }
}

void Session::read_sources() {
    const bool has_meaning = columns_of(reader_, "source").contains("depth_meaning");
    Statement query =
        reader_.rows("SELECT " + source_columns(reader_) + ", " + media_columns(reader_, "c") +
                     ", " + media_columns(reader_, "d") + ", first_tick, " +
                     std::string(has_meaning ? "depth_meaning" : "''") +
                     " FROM source s LEFT JOIN media c ON c.id = s.colour "
                     "LEFT JOIN media d ON d.id = s.depth ORDER BY first_tick");
    while (query.next()) {
        SessionSource& source = sources_.emplace_back();
        Row(query).take(source.source, source.colour, source.depth, source.first_tick,
                        source.depth_meaning);
        keep(sizeof source + source.colour.file.native().size() +
             source.depth.file.native().size() + source.depth_meaning.size());
    }
}

std::vector<SessionMap> Session::maps_of(std::uint32_t version) const {
    constexpr std::size_t kMost_bytes = std::size_t{1} << 28;
    std::vector<SessionMap> maps;
    if (columns_of(reader_, "touch_map").empty()) return maps;  // of before there were maps
    Statement query =
        reader_.rows("SELECT kind, lowest, highest, png FROM touch_map WHERE version = " +
                     std::to_string(version) + " ORDER BY kind, part");
    std::size_t bytes = 0;
    while (query.next()) {
        std::string kind = query.text(0);
        if (maps.empty() || maps.back().kind != kind)
            maps.push_back({std::move(kind), query.real(1), query.real(2), {}});
        const std::string part = query.bytes(3);
        bytes += part.size();
        if (bytes > kMost_bytes)
            throw InputError(file().string() +
                             ": holds larger touch maps than any recording has; choose a file that "
                             "dibhr recorded");
        maps.back().png += part;
    }
    return maps;
}

void Session::read_marks() {
    Statement query = reader_.rows("SELECT t, tag, text FROM mark ORDER BY t, id");
    while (query.next()) {
        SessionMark& mark = marks_.emplace_back();
        Row(query).take(mark.t_s, mark.tag, mark.text);
        keep(sizeof mark + mark.tag.size() + mark.text.size());
    }
}

void Session::keep(std::size_t bytes) {
    constexpr std::size_t kMost_bytes = std::size_t{32} << 20;
    constexpr std::size_t kOverhead_bytes = 100;  // of a row, about
    kept_bytes_ += bytes + kOverhead_bytes;
    if (kept_bytes_ <= kMost_bytes) return;
    throw InputError(file().string() +
                     ": holds more notes, marks and parameters than any recording has; choose a "
                     "file that dibhr recorded");
}

void Session::read_extent() {
    // Not count(*): that is one step of SQLite's machine, which the reader's bound cannot stop.
    Statement count = reader_.rows(
        "SELECT ifnull(sum(1), 0), ifnull(min(tick), 0), ifnull(max(tick), -1) FROM tick_data");
    if (!count.next()) return;
    rows_ = count.integer(0);
    first_tick_ = count.integer(1);
    last_tick_ = count.integer(2);
    constexpr std::int64_t kFarTick = std::int64_t{1} << 62;  // differences stay numbers
    if (first_tick_ < 0 || last_tick_ > kFarTick)
        throw InputError(file().string() + ": is damaged (its ticks are numbered from " +
                         std::to_string(first_tick_) + " to " + std::to_string(last_tick_) +
                         "); copy it again");
    missing_ = last_tick_ - first_tick_ + 1 - rows_;
    begin_s_ = time_from(first_tick_);
    end_s_ = time_from(last_tick_);
}

double Session::time_from(std::int64_t tick) const {
    Statement query = reader_.rows("SELECT t FROM tick WHERE tick >= " + std::to_string(tick) +
                                   " ORDER BY tick LIMIT 1");
    return query.next() ? query.real(0) : 0.0;
}

std::int64_t Session::tick_at(double t_s) const {
    std::int64_t first = first_tick_;
    std::int64_t count = last_tick_ - first_tick_ + 1;
    while (count > 0) {
        const std::int64_t half = count / 2;
        if (time_from(first + half) < t_s) {
            first += half + 1;
            count -= half + 1;
        } else {
            count = half;
        }
    }
    return first;
}

std::optional<double> Session::utc_at(double t_s) const {
    constexpr double kMost_ns = 9e18;  // beyond, a real has no whole nanoseconds in 64 bits
    const double t_ns = t_s * kNanosecondsPerSecond;
    if (!(std::abs(t_ns) < kMost_ns)) return std::nullopt;
    Statement query = reader_.rows(
        "SELECT utc_s - t_ns / 1e9 FROM clock WHERE t_ns <= " + std::to_string(std::llround(t_ns)) +
        " ORDER BY t_ns DESC LIMIT 1");
    return query.next() ? std::optional(query.real(0) + t_s) : std::nullopt;
}

std::optional<ClockDrift> Session::drift() const {
    Statement query = reader_.rows(
        "SELECT (b.utc_s - a.utc_s) - (b.t_ns - a.t_ns) / 1e9, (b.t_ns - a.t_ns) / 1e9 "
        "FROM (SELECT min(t_ns) AS first, max(t_ns) AS last FROM clock) "
        "JOIN clock a ON a.t_ns = first JOIN clock b ON b.t_ns = last WHERE first < last");
    if (!query.next()) return std::nullopt;
    return ClockDrift{query.real(0), query.real(1)};
}

HandTicks hand_ticks(const SessionReader& reader) {
    Statement query = reader.rows("SELECT count(*), sum(stand_in) FROM tick WHERE surface");
    if (!query.next()) return {};
    return {query.integer(0), query.integer(1)};
}

std::int64_t late_ticks(const SessionReader& reader) {
    Statement query =
        reader.rows("SELECT sum(lateness_us >= " + number_text(kLate_us, 1) + ") FROM tick");
    return query.next() ? query.integer(0) : 0;
}

Session::Ticks::Ticks(const Session& session, double from_s)
    : Ticks(session, session.tick_at(from_s)) {}

Session::Ticks::Ticks(const Session& session, std::int64_t from_tick)
    : query_(session.reader_.rows(ticks_from(session.reader_, from_tick, session.is_damaged()))) {}

bool Session::Ticks::next(TickRecord& tick) {
    if (!query_.next()) return false;
    std::int64_t update_ns = 0;
    std::int64_t state = 0;  // the bits that are not in the view
    std::string primitive;
    FramePair& frames = tick.frames;
    Row(query_).take(tick.tick, tick.t_s, tick.dt_s, tick.lateness_us, update_ns, tick.settings,
                     frames.source, frames.from_frame, frames.to_frame, frames.from_s, frames.to_s,
                     frames.span_s, tick.pair, tick.blend, tick.utc_s, tick.video_s, tick.goal,
                     tick.proxy, tick.spring_newton, tick.sent_newton, tick.own_newton, tick.moves,
                     tick.i, tick.j, tick.contact, primitive, tick.buttons, tick.cut, tick.surface,
                     tick.device_ready, tick.mouse_fallback, tick.from_zero, tick.releases_contact,
                     tick.goal_refused, state);
    tick.catching_up = (state & 1) != 0;
    tick.gliding = (state & 2) != 0;
    tick.standstill = (state & 4) != 0;
    tick.motion_unknown = (state & 8) != 0;
    tick.update_us = static_cast<double>(update_ns) / 1e3;
    tick.primitive = static_cast<std::uint8_t>(primitive_named(primitive));
    return true;
}

}  // namespace dibhr
