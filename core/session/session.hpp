// A recorded session, open for reading: its facts, parameters, sources and marks, and its ticks
// one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/session/session_reader.hpp"
#include "core/session/tick_record.hpp"
#include "core/sqlite/database.hpp"

namespace dibhr {

/// How the wall clock went beside the ticks' monotonic one.
struct ClockDrift {
    double gained_s{0.0};  ///< by the wall clock; also where it was set meanwhile
    double over_s{0.0};    ///< of the monotonic clock
};

/// Read while it is recorded or afterwards; the file stays as it is. One thread at a time. Every
/// call that reads throws InputError, with one plain line, for a file that is missing or foreign,
/// or when it meets damage.
class Session {
  public:
    /// Reads all but the ticks; of a file whose damage it meets, what can be read.
    explicit Session(const std::filesystem::path& file, IfDamaged if_damaged = IfDamaged::rescue);

    /// Checks the whole file for damage, as SessionReader does; takes a second or two for an hour's
    /// recording.
    void check() const { reader_.check(); }
    /// Checks it, and goes on with what can be read if it is damaged: warning() says what is
    /// missing.
    void rescue_if_damaged();

    [[nodiscard]] const std::filesystem::path& file() const noexcept { return reader_.file(); }
    [[nodiscard]] const SessionFacts& facts() const noexcept { return facts_; }
    /// The fact, or an empty text.
    [[nodiscard]] std::string fact(const std::string& key) const;
    /// A sentence on what may be missing in the file, and on what of it is not read; empty:
    /// nothing.
    [[nodiscard]] std::string warning() const;
    /// Whether it is what could be read of a damaged recording, or a copy of that.
    [[nodiscard]] bool is_damaged() const { return facts_.contains(kDamageFact); }
    /// Whether it holds the surface of every pair of frames that was felt, if it holds any.
    [[nodiscard]] bool has_all_surfaces() const {
        return !is_damaged() && missing_surfaces_warning().empty();
    }
    /// In the order in which ticks first used them.
    [[nodiscard]] const std::vector<SessionParameters>& parameters() const noexcept {
        return parameters_;
    }
    /// Null when there are none of that version.
    [[nodiscard]] const SessionParameters* parameters_of(std::uint64_t version) const noexcept;
    [[nodiscard]] const std::vector<SessionSource>& sources() const noexcept { return sources_; }
    /// Null when there is none.
    [[nodiscard]] const SessionSource* source_of(const FrameSource& source) const noexcept;
    /// The touch maps of that version; empty: the session does not hold them.
    [[nodiscard]] std::vector<SessionMap> maps_of(std::uint32_t version) const;
    /// In order of time.
    [[nodiscard]] const std::vector<SessionMark>& marks() const noexcept { return marks_; }

    [[nodiscard]] std::int64_t rows() const noexcept { return rows_; }
    [[nodiscard]] double begin_s() const noexcept { return begin_s_; }  ///< the first tick's t_s
    [[nodiscard]] double end_s() const noexcept { return end_s_; }      ///< the last one's
    /// The wall time since 1970 at a time of the ticks; nothing: none was recorded until then.
    [[nodiscard]] std::optional<double> utc_at(double t_s) const;
    /// From which number on ticks are at or after that time; one past the last if there are none.
    [[nodiscard]] std::int64_t tick_at(double t_s) const;
    /// From the first reading of the wall clock to the last; nothing: there are not two.
    [[nodiscard]] std::optional<ClockDrift> drift() const;
    /// How many ticks are missing between the first and the last.
    [[nodiscard]] std::int64_t missing() const noexcept { return missing_; }

    /// The tick's number as people count: the session's first tick is 0.
    [[nodiscard]] std::int64_t count_of(std::int64_t tick) const noexcept {
        return tick - first_tick_;
    }

    /// For other queries to the tables that README.md describes.
    [[nodiscard]] const SessionReader& reader() const noexcept { return reader_; }

    class Ticks;

  private:
    /// All but the ticks.
    void read();
    [[nodiscard]] std::string damage_warning() const;
    [[nodiscard]] std::string missing_surfaces_warning() const;
    /// A sentence on a log that is missing or foreign.
    [[nodiscard]] std::string log_warning() const;
    void read_facts();
    void read_parameters();
    void read_sources();
    void read_marks();
    void read_extent();
    /// Counts the bytes held in memory, and refuses a file that holds too many.
    void keep(std::size_t bytes);
    /// The time of the first tick of that number or a later one.
    [[nodiscard]] double time_from(std::int64_t tick) const;

    SessionReader reader_;
    SessionFacts facts_{};
    std::vector<SessionParameters> parameters_{};
    std::vector<SessionSource> sources_{};
    std::vector<SessionMark> marks_{};
    std::int64_t rows_{0};
    double begin_s_{0.0}, end_s_{0.0};
    std::int64_t first_tick_{0}, last_tick_{-1};
    std::int64_t missing_{0};
    std::size_t kept_bytes_{0};
};

/// The ticks in which a hand was read: those with a surface.
struct HandTicks {
    std::int64_t all{0};
    std::int64_t mouse_fallback{0};  ///< the mouse's, for a device that was not ready

    [[nodiscard]] bool is_mouse_only() const noexcept {
        return mouse_fallback > 0 && mouse_fallback >= all;
    }
};

/// Reads every tick. Throws InputError for a damaged file.
[[nodiscard]] HandTicks hand_ticks(const SessionReader& reader);

/// A tick that begins this much after its deadline is late: a whole period, as in the loop.
inline constexpr double kLate_us = 1000.0;
/// The number of late ticks. Reads every tick. Throws InputError for a damaged file.
[[nodiscard]] std::int64_t late_ticks(const SessionReader& reader);

/// The ticks in order of time; must not outlive its session.
class Session::Ticks {
  public:
    explicit Ticks(const Session& session) : Ticks(session, session.first_tick_) {}
    /// From the first one at or after `from_s` on.
    Ticks(const Session& session, double from_s);

    /// False after the last one.
    [[nodiscard]] bool next(TickRecord& tick);

  private:
    Ticks(const Session& session, std::int64_t from_tick);

    Statement query_;
};

}  // namespace dibhr
