// The manual page and the shells' completions, made of what the commands declare.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/settings/keys.hpp"

namespace dibhr {

/// An option or an argument, as a command declares it.
struct DocumentedOption {
    std::vector<std::string> names{};  ///< "--mute", "-h"; none: an argument
    std::string argument{};            ///< of an argument: "SESSION"
    std::string type{};                ///< of its value: "FILE", "MU"; empty: it takes none
    std::string default_text{};        ///< the default value; empty: none
    std::string help{};
    bool required{false};

    [[nodiscard]] bool is_argument() const { return names.empty(); }
    [[nodiscard]] bool takes_file() const;
    /// The allowed values, where the help lists them: "auto", "bright", "dark".
    [[nodiscard]] std::vector<std::string> values() const;
};

struct DocumentedCommand {
    std::string name{};
    std::string arguments{};  ///< "SESSION --csv FILE"
    std::string summary{};
    std::string examples{};  ///< the end of its help
    std::vector<DocumentedOption> options{};
};

/// In troff, with the macros of man(7).
[[nodiscard]] std::string man_page(const std::vector<DocumentedCommand>& commands);

/// What each key does, and how to change keys.
[[nodiscard]] std::string keys_help(const KeyTable& keys);

/// A script for that shell: bash, zsh or fish. Throws UsageError for another one.
[[nodiscard]] std::string completion_for(std::string_view shell,
                                         const std::vector<DocumentedCommand>& commands);

}  // namespace dibhr
