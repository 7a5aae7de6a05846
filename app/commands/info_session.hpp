// What `dibhr info` says of a session.
#pragma once

#include <string_view>

#include "app/commands/batch/session_batch.hpp"
#include "core/session/session.hpp"

namespace dibhr {

/// A line of a description, on standard output.
void print_fact(std::string_view name, std::string_view value);

/// Prints what the session holds. JSON is one object a line, so that a file that cannot be read
/// does not spoil the next one's.
void describe_session(const Session& session, bool json);

/// The same as text, with the session's line of the summary.
[[nodiscard]] SessionWork describe_in_batch(const GivenFile& file, bool json);

}  // namespace dibhr
