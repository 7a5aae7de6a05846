// The rows that a command writes from a session, in large pieces.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/files/output_file.hpp"

namespace dibhr {

/// Appears whole or not at all, at commit().
class SessionRows {
  public:
    /// "-" is standard output; an empty name writes nothing. Throws InputError when the target
    /// cannot be written, or is the session itself.
    SessionRows(const std::filesystem::path& target, const std::filesystem::path& session);

    [[nodiscard]] bool wanted() const noexcept { return file_.has_value(); }
    /// Rows are appended here; after each, `row_done`.
    [[nodiscard]] std::string& text() noexcept { return text_; }
    void row_done();
    void commit();

  private:
    std::optional<OutputFile> file_{};
    std::string text_{};
};

}  // namespace dibhr
