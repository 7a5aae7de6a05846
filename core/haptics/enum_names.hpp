// An enumeration and the names of its values: one table for both directions.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dibhr {

/// One value of an enumeration.
template <typename Enum>
struct NamedValue {
    Enum value;
    const char* name;   ///< in files and on the command line: "god-object"
    const char* label;  ///< on the panels: "God-object"
};

/// Whether `table` has every value up to `last`, in the order of the enumeration: for a
/// static_assert beside it, so that table and enumeration cannot drift apart.
template <typename Table, typename Enum>
[[nodiscard]] constexpr bool has_all_in_order(const Table& table, Enum last) noexcept {
    for (std::size_t k = 0; k < table.size(); ++k) {
        if (static_cast<std::size_t>(table[k].value) != k) return false;
    }
    return table.size() == static_cast<std::size_t>(last) + 1;
}

/// The entry of `value` in a table that has_all_in_order().
template <typename Table, typename Enum>
[[nodiscard]] constexpr const auto& entry_of(const Table& table, Enum value) noexcept {
    return table[static_cast<std::size_t>(value)];
}

/// The value of this name, or nothing.
template <typename Table>
[[nodiscard]] constexpr auto value_named(const Table& table, std::string_view name) noexcept {
    for (const auto& entry : table) {
        if (name == entry.name) return std::optional(entry.value);
    }
    return decltype(std::optional(table[0].value)){};
}

/// An enumeration with a table of names, name_table(), which has_all_in_order().
template <typename Enum>
concept HasNameTable = requires(Enum value) {
    name_table(value);
};

template <HasNameTable Enum>
[[nodiscard]] constexpr std::string_view name_of(Enum value) noexcept {
    return entry_of(name_table(value), value).name;
}

/// The value of this name, or nothing.
template <HasNameTable Enum>
[[nodiscard]] constexpr std::optional<Enum> named(std::string_view name) noexcept {
    return value_named(name_table(Enum{}), name);
}

/// The names of all entries of a table or a list, in its order.
template <typename Table>
[[nodiscard]] std::vector<std::string> all_names(const Table& table) {
    std::vector<std::string> names;
    for (const auto& entry : table) names.emplace_back(entry.name);
    return names;
}

template <HasNameTable Enum>
[[nodiscard]] std::vector<std::string> all_names() {
    return all_names(name_table(Enum{}));
}

}  // namespace dibhr
