// A record of what Force Dimension's library was asked and answered.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "device/call_record.hpp"
#include "device/forcedimension/calls.hpp"

namespace dibhr::forcedimension {

/// The calls of `library`, and a line of the record for each of them. The file is whole only when
/// this object is destroyed.
class RecordedCalls final : public Calls {
  public:
    /// Throws InputError when the file cannot be written.
    RecordedCalls(std::shared_ptr<Calls> library, const std::filesystem::path& file);
    ~RecordedCalls() override;

    int call(Function function, int id, std::span<const double> given,
             std::span<double> answered) override;
    [[nodiscard]] bool by_hand_only() const noexcept override { return library_->by_hand_only(); }
    [[nodiscard]] const std::string& file() const noexcept override { return library_->file(); }

  private:
    const std::shared_ptr<Calls> library_;
    const std::unique_ptr<CallRecorder> recorder_;
};

/// The file exists and begins as a record does.
[[nodiscard]] bool is_record(const std::filesystem::path& file);

/// Each function answers what it answered last at this time of the record, and after its end what
/// it answered at its end. The time begins with the first call. A record that is damaged is
/// refused with the number of the line.
[[nodiscard]] FoundCalls play_record(const std::filesystem::path& file);

}  // namespace dibhr::forcedimension
