// The rows that a command writes from a session, in large pieces.
#include "app/commands/session_rows.hpp"

#include <cstddef>
#include <system_error>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kPiece_bytes = std::size_t{1} << 20;

}  // namespace

SessionRows::SessionRows(const std::filesystem::path& target,
                         const std::filesystem::path& session) {
    if (target.empty()) return;
    std::error_code missing;
    if (std::filesystem::equivalent(target, session, missing)) {
        throw InputError(target.string() +
                         ": is the session that is read; give --csv another name");
    }
    file_.emplace(target);
}

void SessionRows::row_done() {
    if (text_.size() < kPiece_bytes || !file_) return;
    file_->write(text_);
    text_.clear();
}

void SessionRows::commit() {
    if (!file_) return;
    file_->write(text_);
    file_->commit();
}

}  // namespace dibhr
