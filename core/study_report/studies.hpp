// The study files of one protocol, read together.
#pragma once

#include <filesystem>
#include <vector>

#include "core/study/protocol.hpp"
#include "core/study/study_file.hpp"

namespace dibhr {

/// The files of one protocol, one a participant.
struct Study {
    Protocol protocol{};
    std::vector<StudyRecord> participants{};  ///< by number, then by label

    /// A simulated participant's answers say nothing about people.
    [[nodiscard]] bool has_pilots() const noexcept;
};

/// Throws InputError for a file that is no study or cannot be read, for files of several protocols,
/// and for a label that is there twice.
[[nodiscard]] Study read_studies(const std::vector<std::filesystem::path>& files);

}  // namespace dibhr
