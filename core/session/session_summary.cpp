// Reads rows, duration and facts of a session file.
#include "core/session/session_summary.hpp"

#include "core/session/session_reader.hpp"

namespace dibhr {

SessionSummary summarise_session(const std::filesystem::path& file) {
    const SessionReader session(file);
    SessionSummary summary;
    SessionReader::Query ticks(session, "SELECT count(*), ifnull(max(t) - min(t), 0) FROM tick");
    if (ticks.next()) {
        summary.rows = ticks.integer(0);
        summary.duration_s = ticks.real(1);
    }
    SessionReader::Query facts(session, "SELECT key, value FROM session");
    while (facts.next()) summary.facts[facts.text(0)] = facts.text(1);
    return summary;
}

}  // namespace dibhr
