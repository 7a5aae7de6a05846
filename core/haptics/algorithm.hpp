// The proxy algorithms by name.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/haptics/words.hpp"

namespace dibhr {

/// How the proxy follows the goal; see dibhr.hpp, pga.hpp, neighborhood.hpp, god_object.hpp.
enum class Algorithm { dibhr, pga, neighborhood, god_object };

/// All of them, in the order of the enumeration.
[[nodiscard]] std::span<const Algorithm> all_algorithms() noexcept;
/// The same with what they are called.
[[nodiscard]] std::span<const Word<Algorithm>> algorithm_words() noexcept;

/// "dibhr", "pga", "neighborhood" or "god-object": what `--algorithm` takes.
[[nodiscard]] const char* name_of(Algorithm algorithm) noexcept;

/// The algorithm of this name, or nothing.
[[nodiscard]] std::optional<Algorithm> algorithm_named(std::string_view name) noexcept;

}  // namespace dibhr
