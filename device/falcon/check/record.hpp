// The record of a check: one JSON file, written again after every step.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "device/falcon/attached.hpp"
#include "device/falcon/check/findings.hpp"
#include "device/falcon/check/measured.hpp"

namespace dibhr::falcon {

/// How a step ended.
enum class StepEnd { done, skipped, quit, failed, not_begun };

class CheckRecord {
  public:
    /// `file` empty: falcon-check-SERIAL-DATE.json in the current folder.
    CheckRecord(std::filesystem::path file, const AttachedFalcon& falcon,
                const std::vector<std::pair<std::string, std::string>>& facts);

    /// `remark`: why it failed or was not begun.
    void add(const char* step, StepEnd end, const std::string& remark, double seconds,
             const Measured& measured);
    /// The whole file, or none of it. Throws InputError.
    void write(const Findings& findings) const;

    [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

  private:
    std::filesystem::path file_;
    Measured head_{};
    MeasuredList steps_{};
};

}  // namespace dibhr::falcon
