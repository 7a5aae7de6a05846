// Table 1 of the paper: what ours is printed beside.
#pragma once

#include <optional>
#include <string_view>

#include "core/haptics/touch.hpp"

namespace dibhr {

/// Cha, Eid and El Saddik 2008, Table 1: an update on a Pentium D of 3.4 GHz.
struct PaperResult {
    double update_us{0.0};
    double variation_mean_deg{0.0};
    double variation_sd_deg{0.0};
};

/// Nothing for what the paper did not run: the god-object.
[[nodiscard]] std::optional<PaperResult> paper_result(std::string_view path,
                                                      Algorithm algorithm) noexcept;

}  // namespace dibhr
