// What files of others get only when a person here agrees to it: values that protect the hand less,
// and commands that are run. What was agreed to is kept in this installation's own record.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/settings/settings.hpp"

namespace dibhr {

/// A setting that protects the hand less than usual, to which nobody has agreed.
struct Doubt {
    std::string_view table{}, name{};  ///< of the Setting
    std::string_view what{};           ///< "Max force [N]"
    std::string usual{}, asked{};      ///< "4" and "8"
    std::string record{};              ///< its line in the record
};

/// $XDG_STATE_HOME/dibhr/agreed, or ~/.local/state/dibhr/agreed.
[[nodiscard]] std::filesystem::path consent_path();

class Consent {
  public:
    explicit Consent(std::filesystem::path record = consent_path()) : record_(std::move(record)) {}

    /// The usual value takes the place of each doubted one. Those.
    [[nodiscard]] std::vector<Doubt> hold(Settings& settings) const;
    /// The same where nobody can be asked: a warning on stderr tells it. `file`: theirs.
    void hold_and_warn(Settings& settings, const std::filesystem::path& file) const;
    [[nodiscard]] bool knows(const std::string& command) const;

    // A person's word. These throw InputError where it cannot be kept.
    void agree(const std::vector<Doubt>& doubts) const;
    void agree(const std::string& command) const;
    /// By the panels: every value that differs between the two.
    void agree_to_changes(Settings before, Settings now) const;

  private:
    [[nodiscard]] std::set<std::string> agreed() const;
    void add(const std::vector<std::string>& lines) const;

    std::filesystem::path record_;
};

/// The values of these settings alone.
void copy_doubted(const std::vector<Doubt>& doubts, Settings from, Settings& to);

/// Those that a person has changed meanwhile are none any more. `now`: since hold().
void drop_changed(std::vector<Doubt>& doubts, Settings now);

/// For a warning.
[[nodiscard]] std::string in_words(const std::vector<Doubt>& doubts,
                                   const std::filesystem::path& file);

}  // namespace dibhr
