// What of a study's page makes sense beyond what each key may be: a block as a whole, and what only
// other rooms know. Every function throws InputError with the line, and what is allowed.
#pragma once

#include <string>

#include "core/error.hpp"
#include "core/study/protocol.hpp"
#include "core/study/toml_page.hpp"

namespace dibhr {

/// In a block, in all of its trials.
inline constexpr int kMostTrials = 10000;

/// What a check of StudyChecks has against a thing is told at the key.
template <typename Check, typename Thing>
void require(const Check& check, const Thing& thing, const PageTable& table,
             const std::string& key) {
    if (!check) return;
    try {
        check(thing);
    } catch (const Error& error) {
        table.refuse(key, error.what());
    }
}

/// Values that can be felt. What is against them is told at the number that it begins with, or at
/// `key` where the table does not have that; `of` says of what.
void require_values(const StudyChecks& checks, const TouchValues& values, const PageTable& table,
                    const std::string& key, const std::string& of);

/// A block has no keys that only other forms have.
void require_keys_of_form(const PageTable& table, TrialForm form);

/// A block of which every part is read can be run.
void require_sense(const PageTable& table, const Block& block);

/// And is worth running: what is varied can be felt at all of its values and is nothing that a
/// condition has otherwise, and what is asked can be told. The blocks of `protocol` came before.
/// `base`: what all conditions have.
void require_worth(PageTable& table, const Protocol& protocol, const TouchValues& base,
                   const Block& block, const StudyChecks& checks);

}  // namespace dibhr
