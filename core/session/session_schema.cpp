// The tables, the view over the ticks, and the explanations of its columns.
#include "core/session/session_schema.hpp"

#include <type_traits>

#include "core/files/content_hash.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/safety.hpp"
#include "core/haptics/surface.hpp"
#include "core/session/tick_record.hpp"

namespace dibhr {

namespace {

// Untyped columns keep every bit of a real, the sign of a zero too.
constexpr std::string_view kTables = R"(
CREATE TABLE session(key TEXT PRIMARY KEY, value TEXT);
CREATE TABLE media(id INTEGER PRIMARY KEY, file TEXT UNIQUE, bytes INTEGER, sha256 TEXT,
  head_bytes INTEGER);
CREATE TABLE pair(id INTEGER PRIMARY KEY, source INTEGER, from_frame INTEGER, to_frame INTEGER,
  from_s, to_s, span_s);
CREATE TABLE clock(t_ns INTEGER PRIMARY KEY, utc_s REAL, dropped INTEGER, high_water INTEGER);
CREATE TABLE mark(id INTEGER PRIMARY KEY, t REAL, tag TEXT, text TEXT);
CREATE TABLE cut(code INTEGER PRIMARY KEY, name TEXT);
CREATE TABLE tick_column(name TEXT, unit TEXT, meaning TEXT);
CREATE TABLE touch_map(version INTEGER, kind TEXT, part INTEGER, lowest REAL, highest REAL, png BLOB,
  PRIMARY KEY(version, kind, part));
CREATE TABLE surface(pair INTEGER, part INTEGER, highest REAL, levels INTEGER, unseen INTEGER,
  right INTEGER, down INTEGER, PRIMARY KEY(pair, part)) WITHOUT ROWID;
CREATE TABLE preview(pair INTEGER PRIMARY KEY, jpeg BLOB);
CREATE TABLE bump_map(media INTEGER PRIMARY KEY, grid INTEGER);
CREATE TABLE grid(id INTEGER PRIMARY KEY, columns INTEGER, rows INTEGER);
CREATE TABLE grid_tile(grid INTEGER, place INTEGER, tile INTEGER, PRIMARY KEY(grid, place))
  WITHOUT ROWID;
CREATE TABLE tile(id INTEGER PRIMARY KEY, code BLOB);
)";

std::string source_table() {
    std::string table =
        "CREATE TABLE source(id INTEGER PRIMARY KEY, first_tick INTEGER, media INTEGER, "
        "colour INTEGER, depth INTEGER, depth_meaning TEXT";
    FrameSource source;
    visit_cleaning(source, [&table](std::string_view column, const auto& fact) {
        const bool is_real = std::is_floating_point_v<std::remove_cvref_t<decltype(fact)>>;
        table += ", " + std::string(column) + (is_real ? " REAL" : " INTEGER");
    });
    return table + ");\n";
}

std::string parameters_table() {
    std::string table = "CREATE TABLE parameters(version INTEGER PRIMARY KEY, first_tick INTEGER";
    const auto add = [&table](std::string_view column, const char* type) {
        table += ", " + std::string(column) + type;
    };
    for (const TouchChoice& choice : touch_choices()) add(choice.column, " TEXT");
    SessionParameters parameters;
    visit_numbers(parameters, [&add](std::string_view column, double) { add(column, " REAL"); });
    table += ", force_enabled INTEGER, bump INTEGER";
    for (const TouchSwitch& entry : touch_switches()) add(entry.column, " INTEGER");
    return table + ");\n";
}

/// A column of the view `tick`: its type and the expression that gives it.
struct Column {
    std::string_view name;
    std::string_view type;
    std::string expression;
    std::string_view unit;
    std::string meaning;
};

/// The bits of `state` from `shift` on.
std::string bits(int shift, int mask) {
    return "d.state >> " + std::to_string(shift) + " & " + std::to_string(mask);
}

std::string flag_unless(int shift) {
    return "1 - (" + bits(shift, 1) + ")";
}

/// With six digits after the point: these texts are compared when a file is read.
std::string real_text(double value) {
    return number_text(value, 6);
}

/// Whole nanoseconds, or else a real in the unit itself.
std::string time_of(const std::string& column, double nanoseconds) {
    return "CASE typeof(" + column + ") WHEN 'integer' THEN " + column + " / " +
           real_text(nanoseconds) + " ELSE " + column + " END";
}

std::string proxy_of(const std::string& axis) {
    return "coalesce(d.p" + axis + ", d.g" + axis + ")";
}

/// In the order of the multiplications in coupling_force(), so that the bits are the same.
std::string spring_of(const std::string& axis) {
    return "coalesce(d.f" + axis + ", s.stiffness_newton_per_mm * s.pixel_pitch_mm * (" +
           proxy_of(axis) + " - d.g" + axis + "))";
}

std::string own_of(const std::string& axis) {
    return "coalesce(d.o" + axis + ", 0.0)";
}

/// The input of the safety stage.
std::string wanted_of(const std::string& axis) {
    return "(" + spring_of(axis) + " + " + own_of(axis) + ")";
}

/// Nothing was sent if the force was cut, else what was wanted.
std::string sent_of(const std::string& axis) {
    return "coalesce(d.c" + axis + ", CASE WHEN " + bits(tick_state::kCut, 7) + " THEN 0.0 ELSE " +
           wanted_of(axis) + " END)";
}

/// The inverse of off_direction() and add_forces() in session_file.cpp.
std::string shortened_of(const std::string& axis) {
    return "CASE typeof(d.c" + axis + ") WHEN 'integer' THEN " + wanted_of(axis) + " * (CAST(" +
           sent_of("z") + " AS REAL) / " + wanted_of("z") + ") + d.c" + axis + " / CAST(" +
           std::to_string(kPartsPerNewton) + " AS REAL) ELSE " + sent_of(axis) + " END";
}

/// The time since the tick before.
std::string time_between() {
    return "CASE WHEN d.dt IS NULL THEN (d.t - (SELECT b.t FROM tick_data b WHERE b.tick = d.tick "
           "- 1)) / " +
           real_text(kNanosecondsPerSecond) + " ELSE " + time_of("d.dt", kNanosecondsPerSecond) +
           " END";
}

/// The pixel the proxy is in, for a primitive.
std::string pixel_of(const std::string& index, const std::string& axis) {
    return "coalesce(d." + index + ", CAST(" + proxy_of(axis) + " AS INTEGER))";
}

std::string primitive_name() {
    std::string text = "CASE " + bits(tick_state::kPrimitive, 3);
    for (int kind = 0; kind <= static_cast<int>(kLastPrimitiveKind); ++kind)
        text += " WHEN " + std::to_string(kind) + " THEN '" +
                name_of(static_cast<PrimitiveKind>(kind)) + "'";
    return text + " END";
}

/// "0 not cut, 1 not finite, ...".
std::string cut_codes() {
    std::string text = "0 not cut";
    for (int code = 1; code <= static_cast<int>(kLastSafetyCut); ++code)
        text += ", " + std::to_string(code) + ' ' + name_of(static_cast<SafetyCut>(code));
    return text;
}

/// The output rows' columns first, by the same names and in the same order.
std::array<Column, 41> columns() {
    namespace at = tick_state;
    const std::string t = time_of("d.t", kNanosecondsPerSecond);
    const std::string wall =
        "(SELECT c.utc_s - c.t_ns / 1e9 FROM clock c WHERE c.t_ns <= "
        "CASE typeof(d.t) WHEN 'integer' THEN d.t ELSE d.t * 1e9 END "
        "ORDER BY c.t_ns DESC LIMIT 1) + (" +
        t + ")";
    return {{
        {"t", "REAL", t, "s", "monotonic time since the loop began"},
        {"gx", "REAL", "d.gx", "px", "goal, x (column)"},
        {"gy", "REAL", "d.gy", "px", "goal, y (row)"},
        {"gz", "REAL", "d.gz", "px", "goal, z (elevation towards the viewer)"},
        {"px", "REAL", proxy_of("x"), "px", "proxy, x"},
        {"py", "REAL", proxy_of("y"), "px", "proxy, y"},
        {"pz", "REAL", proxy_of("z"), "px", "proxy, z"},
        {"fx", "REAL", spring_of("x"), "N", "spring force before the safety stage, x"},
        {"fy", "REAL", spring_of("y"), "N", "spring force before the safety stage, y"},
        {"fz", "REAL", spring_of("z"), "N", "spring force before the safety stage, z"},
        {"cx", "REAL", shortened_of("x"), "N", "force sent to the device, x"},
        {"cy", "REAL", shortened_of("y"), "N", "force sent to the device, y"},
        {"cz", "REAL", sent_of("z"), "N", "force sent to the device, z"},
        {"contact", "INTEGER", bits(at::kContact, 1), "",
         "1 while the proxy touches the surface; 0 without a surface"},
        {"primitive", "TEXT", primitive_name(), "",
         "what the proxy rests on: none, triangle, edge or vertex"},
        {"i", "INTEGER", pixel_of("i", "x"), "", "the primitive's column, -1 for none"},
        {"j", "INTEGER", pixel_of("j", "y"), "", "the primitive's row, -1 for none"},
        {"moves", "INTEGER", "d.moves", "", "primitives visited in the update"},
        {"ns", "INTEGER", "d.ns", "ns", "time of the update"},
        {"tick", "", "d.tick", "", "number of the tick in its loop"},
        {"utc_s", "REAL", wall, "s", "wall time since 1970-01-01 00:00 UTC"},
        {"video_s", "REAL", "q.from_s + d.blend * q.span_s", "s",
         "presentation time in the video of what was touched; NULL without a surface"},
        {"blend", "REAL", "d.blend", "", "0: depth frame `frame`, 1: `to_frame`"},
        {"frame", "", "q.from_frame", "", "number of the depth frame in its file, from 0"},
        {"to_frame", "", "q.to_frame", "", "number of the frame it blends into"},
        {"pair", "", "q.id", "", "the two frames: id in table pair"},
        {"source", "", "q.source", "", "files and cleaning of the frames: id in table source"},
        {"settings", "", "d.settings", "", "version in table parameters"},
        {"dt_s", "REAL", time_between(), "s", "since the tick before began"},
        {"lateness_us", "REAL", time_of("d.lateness", kNanosecondsPerMicrosecond), "us",
         "how long after its deadline the tick began"},
        {"buttons", "INTEGER", bits(at::kButtons, 255), "", "bit 0: the device's main button"},
        {"cut", "INTEGER", bits(at::kCut, 7), "", "why the force was cut: " + cut_codes()},
        {"surface", "INTEGER", flag_unless(at::kNoSurface), "",
         "1: there was a surface; without, nothing is updated and no force sent"},
        {"ready", "INTEGER", flag_unless(at::kNotReady), "",
         "1: the device was attached and homed"},
        {"stand_in", "INTEGER", bits(at::kMouseFallback, 1), "",
         "1: the mouse moved the hand, for a device that was not ready"},
        {"restart", "INTEGER", bits(at::kFromZero, 1), "", "1: the force began from zero again"},
        {"lets_go", "INTEGER", bits(at::kReleasesContact, 1), "",
         "1: the hand was lifted or replaced, and a contact was let go first"},
        {"refused", "INTEGER", bits(at::kRefused, 1), "",
         "1: the hand's place was no number; the goal is the one before"},
        {"ox", "REAL", own_of("x"), "N", "what the device itself adds, x"},
        {"oy", "REAL", own_of("y"), "N", "what the device itself adds, y"},
        {"oz", "REAL", own_of("z"), "N", "what the device itself adds, z"},
    }};
}

std::string quoted(std::string_view text) {
    std::string quotation = "'";
    for (const char c : text) quotation += c == '\'' ? std::string("''") : std::string(1, c);
    return quotation + "'";
}

std::string explanations() {
    std::string text;
    for (const Column& column : columns())
        text += "INSERT INTO tick_column VALUES(" + quoted(column.name) + "," +
                quoted(column.unit) + "," + quoted(std::string_view(column.meaning)) + ");\n";
    for (int code = 0; code <= static_cast<int>(kLastSafetyCut); ++code)
        text += "INSERT INTO cut VALUES(" + std::to_string(code) + "," +
                quoted(name_of(static_cast<SafetyCut>(code))) + ");\n";
    return text;
}

/// The tables that the first schema lacks, with the columns that every reader asks for.
constexpr std::string_view kAbsentTables = R"(
CREATE TEMP TABLE media(id INTEGER PRIMARY KEY, file TEXT, bytes INTEGER, sha256 TEXT);
CREATE TEMP TABLE source(id INTEGER PRIMARY KEY, first_tick INTEGER, media INTEGER, colour INTEGER,
  depth INTEGER);
CREATE TEMP TABLE parameters(version INTEGER PRIMARY KEY, first_tick INTEGER, algorithm TEXT,
  force_enabled INTEGER, bump INTEGER);
CREATE TEMP TABLE pair(id INTEGER PRIMARY KEY, source INTEGER, from_frame INTEGER,
  to_frame INTEGER, from_s, to_s, span_s);
CREATE TEMP TABLE clock(t_ns INTEGER PRIMARY KEY, utc_s REAL, dropped INTEGER, high_water INTEGER);
CREATE TEMP TABLE mark(id INTEGER PRIMARY KEY, t REAL, tag TEXT, text TEXT);
CREATE TEMP TABLE tick_data(tick INTEGER PRIMARY KEY, at INTEGER, state INTEGER);
INSERT INTO tick_data SELECT tick, rowid, 0 FROM main.tick;
)";

/// The value of a column of the view, from the first schema's table `tick`: b.
std::string first_schema_value(const Column& column) {
    const std::string_view name = column.name;
    for (const std::string_view absent : {"utc_s", "pair", "source", "settings"})
        if (name == absent) return "NULL";
    for (const std::string_view off : {"stand_in", "restart", "lets_go", "refused"})
        if (name == off) return "0";
    for (const std::string_view on : {"surface", "ready"})
        if (name == on) return "1";
    for (const std::string_view own : {"ox", "oy", "oz"})
        if (name == own) return "0.0";
    if (name == "video_s") return "b.playback_s";
    if (name == "tick") return "d.tick";
    return name == "to_frame" ? "b.frame + 1" : "b." + std::string(name);
}

}  // namespace

std::vector<TickColumn> tick_columns() {
    std::vector<TickColumn> explained;
    for (const Column& column : columns())
        explained.push_back({std::string(column.name), std::string(column.unit), column.meaning});
    return explained;
}

std::string tick_view(std::string_view create) {
    std::string select;
    for (const Column& column : columns()) {
        select += select.empty() ? std::string(create) + " tick AS SELECT " : ",\n  ";
        // A plain column keeps its declared type by itself.
        select += column.type.empty()
                      ? column.expression
                      : "CAST(" + column.expression + " AS " + std::string(column.type) + ")";
        select += " AS " + std::string(column.name);
    }
    return select +
           "\nFROM tick_data d LEFT JOIN pair q ON q.id = d.pair"
           " LEFT JOIN parameters s ON s.version = d.settings";
}

std::string first_schema_as_this_one() {
    std::string select;
    for (const Column& column : columns())
        select += (select.empty() ? "SELECT " : ", ") + first_schema_value(column) + " AS " +
                  std::string(column.name);
    return "PRAGMA temp_store = MEMORY;" + std::string(kAbsentTables) +
           "CREATE TEMP VIEW tick AS " + select +
           " FROM tick_data d CROSS JOIN main.tick b ON b.rowid = d.at;\n";
}

bool is_tick_view(const std::string& sql) {
    // The SHA-256 of the view of 2026-11-20, which had other bits in `state` and coded no force
    // that a limit shortened.
    constexpr std::string_view kFirstView =
        "a592b0e319a5679f766be8ea57daed734de24ea448c97e2a7cfbe3ce1fea7cfa";
    if (sql == tick_view()) return true;
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(sql.data());
    return sha256_of({bytes, sql.size()}) == kFirstView;
}

std::string session_schema() {
    return std::string(kTables) + source_table() + parameters_table() +
           "CREATE TABLE tick_data(tick INTEGER PRIMARY KEY, t, dt, lateness, ns, state, pair, "
           "blend, settings INTEGER, moves, i, j, gx, gy, gz, px, py, pz, fx, fy, fz, cx, cy, cz, "
           "ox, oy, oz);\n" +
           tick_view() + ";\n" + explanations() +
           "PRAGMA application_id = " + std::to_string(kSessionApplicationId) +
           ";\nPRAGMA user_version = " + std::to_string(kSessionSchemaVersion) + ";\n";
}

}  // namespace dibhr
