// Validates a study's page beyond the range of each key: blocks as a whole, and values that other
// rooms check. Every function throws InputError with the line and the allowed values.
#pragma once

#include <string>

#include "core/error.hpp"
#include "core/study/protocol.hpp"
#include "core/study/toml_page.hpp"

namespace dibhr {

/// The trials of a block.
inline constexpr int kMostTrials = 10000;

/// Runs a check of StudyChecks, and throws its error with the line of `key`.
template <typename Check, typename Thing>
void require_usable(const Check& check, const Thing& thing, const PageTable& table,
                    const std::string& key) {
    if (!check) return;
    try {
        check(thing);
    } catch (const Error& error) {
        table.refuse(key, error.what());
    }
}

/// Checks values. An error is thrown with the line of the number that it begins with, or of `key`
/// where the table lacks that number; `of` names the values.
void require_values(const StudyChecks& checks, const TouchValues& values, const PageTable& table,
                    const std::string& key, const std::string& of);

/// A block has no keys that only other forms have.
void require_keys_of_form(const PageTable& table, TrialForm form);

/// Checks that a completely read block is consistent, so that it can run.
void require_valid_block(const PageTable& table, const Block& block);

/// Checks that a consistent block gives useful answers: all values are allowed, no condition sets
/// the varied parameter, and a question has a right answer where one is needed. `protocol` has the
/// blocks before it. `base`: the values of all conditions.
void require_useful_block(PageTable& table, const Protocol& protocol, const TouchValues& base,
                          const Block& block, const StudyChecks& checks);

}  // namespace dibhr
