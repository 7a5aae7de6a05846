// A recorded session, open for reading.
#include "core/session/session.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/haptics/primitive.hpp"

namespace dibhr {

namespace {

/// Takes the columns of a row one after the other.
class Row {
  public:
    explicit Row(const SessionReader::Query& query) : query_(query) {}

    double real() { return query_.real(column_++); }
    std::int64_t integer() { return query_.integer(column_++); }
    bool yes() { return integer() != 0; }
    std::string text() { return query_.text(column_++); }
    template <typename Number>
    Number whole() {
        return static_cast<Number>(integer());
    }
    Vec3 vector() { return {real(), real(), real()}; }  // braces: from left to right
    SessionMedia media() {
        SessionMedia media;
        media.file = text();
        media.bytes = whole<std::uint64_t>();
        media.sha256 = text();
        return media;
    }
    FrameSource source() {
        FrameSource source;
        source.media = whole<std::uint32_t>();
        source.fill_holes = yes();
        source.remove_spikes = yes();
        source.smooth_steps = yes();
        return source;
    }

  private:
    const SessionReader::Query& query_;
    int column_{0};
};

/// A file of before a parameter has no column for it: the parameter then was what it is by default.
std::set<std::string> columns_of_parameters(const SessionReader& reader) {
    std::set<std::string> columns;
    SessionReader::Query query(reader, "SELECT name FROM pragma_table_info('parameters')");
    while (query.next()) columns.insert(query.text(0));
    return columns;
}

PrimitiveKind primitive_named(const std::string& name) {
    for (const auto kind : {PrimitiveKind::triangle, PrimitiveKind::edge, PrimitiveKind::vertex}) {
        if (name == name_of(kind)) return kind;
    }
    return PrimitiveKind::none;
}

// In the order in which Ticks::next takes them.
constexpr const char* kTickQuestion =
    "SELECT t.tick, t.t, t.dt_s, t.lateness_us, t.ns, t.settings, "
    "s.media, s.fill_holes, s.remove_spikes, s.smooth_steps, "
    "t.frame, t.to_frame, q.from_s, q.to_s, q.span_s, t.blend, t.utc_s, t.video_s, "
    "t.gx, t.gy, t.gz, t.px, t.py, t.pz, t.fx, t.fy, t.fz, t.cx, t.cy, t.cz, t.ox, t.oy, t.oz, "
    "t.moves, t.i, t.j, t.contact, t.primitive, t.buttons, t.cut, "
    "t.surface, t.ready, t.stand_in, t.restart, t.lets_go, t.refused "
    "FROM tick t LEFT JOIN pair q ON q.id = t.pair LEFT JOIN source s ON s.id = q.source WHERE "
    "t.tick >= ";
constexpr const char* kInOrder = " ORDER BY t.tick";

}  // namespace

Session::Session(const std::filesystem::path& file) : reader_(file) {
    read_facts();
    read_parameters();
    read_sources();
    read_marks();
    read_extent();
}

void Session::check() const {
    reader_.check();
}

std::string Session::fact(const std::string& key) const {
    const auto found = facts_.find(key);
    return found == facts_.end() ? std::string{} : found->second;
}

std::string Session::warning() const {
    // The log may also have been merged by another program.
    if (!reader_.lacks_log() || fact("complete") != "0") return {};
    return file().string() + ": its recording was broken off, and its last moments may be in " +
           file().filename().string() + "-wal, which is not here; copy both files";
}

const SessionParameters* Session::parameters_of(std::uint64_t version) const noexcept {
    const auto found =
        std::find_if(parameters_.begin(), parameters_.end(),
                     [version](const SessionParameters& each) { return each.version == version; });
    return found == parameters_.end() ? nullptr : &*found;
}

const SessionSource* Session::source_of(const FrameSource& source) const noexcept {
    const auto found =
        std::find_if(sources_.begin(), sources_.end(),
                     [&source](const SessionSource& each) { return each.source == source; });
    return found == sources_.end() ? nullptr : &*found;
}

void Session::read_facts() {
    SessionReader::Query query(reader_, "SELECT key, value FROM session");
    while (query.next()) facts_[query.text(0)] = query.text(1);
}

void Session::read_parameters() {
    const std::set<std::string> columns = columns_of_parameters(reader_);
    std::string question =
        "SELECT version, first_tick, algorithm, force_enabled, m.file, m.bytes, m.sha256";
    SessionParameters standard;
    visit_numbers(standard, [&](std::string_view column, double) {
        if (columns.contains(std::string(column))) question += ", " + std::string(column);
    });
    SessionReader::Query query(
        reader_,
        question + " FROM parameters LEFT JOIN media m ON m.id = bump ORDER BY first_tick");
    while (query.next()) {
        Row row(query);
        SessionParameters parameters;
        parameters.version = row.whole<std::uint64_t>();
        parameters.first_tick = row.integer();
        const std::string name = row.text();
        const auto algorithm = algorithm_named(name);
        if (!algorithm) {
            throw InputError(file().string() + ": was recorded with an algorithm '" + name +
                             "' that is not known here; update dibhr");
        }
        parameters.touch.algorithm = *algorithm;
        parameters.force_enabled = row.yes();
        parameters.bump = row.media();
        visit_numbers(parameters, [&](std::string_view column, double& number) {
            if (columns.contains(std::string(column))) number = row.real();
        });
        parameters_.push_back(std::move(parameters));
    }
}

void Session::read_sources() {
    SessionReader::Query query(
        reader_,
        "SELECT s.media, fill_holes, remove_spikes, smooth_steps, c.file, c.bytes, c.sha256, "
        "d.file, d.bytes, d.sha256, first_tick FROM source s LEFT JOIN media c ON c.id = s.colour "
        "LEFT JOIN media d ON d.id = s.depth ORDER BY first_tick");
    while (query.next()) {
        Row row(query);
        SessionSource source;
        source.source = row.source();
        source.colour = row.media();
        source.depth = row.media();
        source.first_tick = row.integer();
        sources_.push_back(std::move(source));
    }
}

void Session::read_marks() {
    SessionReader::Query query(reader_, "SELECT t, tag, text FROM mark ORDER BY t, id");
    while (query.next()) {
        Row row(query);
        const double t_s = row.real();
        std::string tag = row.text();
        marks_.push_back({t_s, std::move(tag), row.text()});
    }
}

void Session::read_extent() {
    SessionReader::Query count(
        reader_, "SELECT count(*), ifnull(min(tick), 0), ifnull(max(tick), -1) FROM tick_data");
    if (!count.next()) return;
    rows_ = count.integer(0);
    first_tick_ = count.integer(1);
    last_tick_ = count.integer(2);
    constexpr std::int64_t kFarTick = std::int64_t{1} << 62;  // differences stay numbers
    if (first_tick_ < 0 || last_tick_ > kFarTick) {
        throw InputError(file().string() + ": is damaged (its ticks are numbered from " +
                         std::to_string(first_tick_) + " to " + std::to_string(last_tick_) +
                         "); copy it again");
    }
    missing_ = last_tick_ - first_tick_ + 1 - rows_;
    begin_s_ = time_from(first_tick_);
    end_s_ = time_from(last_tick_);
}

double Session::time_from(std::int64_t tick) const {
    SessionReader::Query query(reader_, "SELECT t FROM tick WHERE tick >= " + std::to_string(tick) +
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

HandTicks hand_ticks(const SessionReader& reader) {
    SessionReader::Query query(reader, "SELECT count(*), sum(stand_in) FROM tick WHERE surface");
    if (!query.next()) return {};
    return {query.integer(0), query.integer(1)};
}

Session::Ticks::Ticks(const Session& session)
    : query_(session.reader_, kTickQuestion + std::to_string(session.first_tick_) + kInOrder) {}

Session::Ticks::Ticks(const Session& session, double from_s)
    : query_(session.reader_, kTickQuestion + std::to_string(session.tick_at(from_s)) + kInOrder) {}

bool Session::Ticks::next(TickRecord& tick) {
    if (!query_.next()) return false;
    Row row(query_);
    tick.tick = row.integer();
    tick.t_s = row.real();
    tick.dt_s = row.real();
    tick.lateness_us = row.real();
    tick.update_us = static_cast<double>(row.integer()) / 1e3;
    tick.settings = row.whole<std::uint64_t>();
    tick.frames.source = row.source();
    tick.frames.from_frame = row.integer();
    tick.frames.to_frame = row.integer();
    tick.frames.from_s = row.real();
    tick.frames.to_s = row.real();
    tick.frames.span_s = row.real();
    tick.blend = row.real();
    tick.utc_s = row.real();
    tick.video_s = row.real();
    tick.goal = row.vector();
    tick.proxy = row.vector();
    tick.spring_newton = row.vector();
    tick.sent_newton = row.vector();
    tick.own_newton = row.vector();
    tick.moves = row.whole<std::int32_t>();
    tick.i = row.whole<std::int32_t>();
    tick.j = row.whole<std::int32_t>();
    tick.contact = row.yes();
    tick.primitive = static_cast<std::uint8_t>(primitive_named(row.text()));
    tick.buttons = row.whole<std::uint8_t>();
    tick.cut = row.whole<std::uint8_t>();
    tick.surface = row.yes();
    tick.device_ready = row.yes();
    tick.stand_in = row.yes();
    tick.from_zero = row.yes();
    tick.lets_go = row.yes();
    tick.goal_refused = row.yes();
    return true;
}

}  // namespace dibhr
