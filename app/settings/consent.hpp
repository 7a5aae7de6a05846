// Consent to what a file of others can request: values that protect the hand less than the
// defaults, and commands to run. It is recorded for this installation.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/settings/settings.hpp"

namespace dibhr {

/// A setting that protects the hand less than its default, without the user's consent.
struct UnsafeSetting {
    std::string_view table{}, name{};  ///< names of the Setting
    std::string_view what{};           ///< for the user: "Max force [N]"
    std::string usual{}, requested{};  ///< default and requested value: "4" and "8"
    std::string record{};              ///< line that consent adds to the record
};

/// $XDG_STATE_HOME/dibhr/agreed, or ~/.local/state/dibhr/agreed.
[[nodiscard]] std::filesystem::path consent_path();

class Consent {
  public:
    explicit Consent(std::filesystem::path record = consent_path()) : record_(std::move(record)) {}

    /// Replaces every value without consent by its default. Returns the replaced values.
    [[nodiscard]] std::vector<UnsafeSetting> replace_unsafe(Settings& settings) const;
    /// The same without a window to ask in: prints a warning. `file`: where the settings come from.
    void replace_unsafe_and_warn(Settings& settings, const std::filesystem::path& file) const;
    [[nodiscard]] bool has_agreed_to(const std::string& command) const;

    // Record the user's consent. Throw InputError where the record cannot be written.
    void agree(const std::vector<UnsafeSetting>& unsafe_settings) const;
    void agree(const std::string& command) const;
    /// Consent by use of the panels: to every value that differs between the two.
    void agree_to_changes(Settings before, Settings now) const;

  private:
    [[nodiscard]] std::set<std::string> agreed() const;
    void add(const std::vector<std::string>& lines) const;

    std::filesystem::path record_;
};

/// Copies the values of these settings only.
void copy_unsafe(const std::vector<UnsafeSetting>& unsafe_settings, Settings from, Settings& to);

/// Removes the settings that the user has changed from their default since the replacement.
void drop_changed(std::vector<UnsafeSetting>& unsafe_settings, Settings now);

/// The text of a warning about these settings of `file`; empty: there are none.
[[nodiscard]] std::string warning_text(const std::vector<UnsafeSetting>& unsafe_settings,
                                       const std::filesystem::path& file);

}  // namespace dibhr
