// The command line of a depth estimator as the user wrote it, with places for files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dibhr {

/// The files and folders for the places of a command.
struct EstimatorPlaces {
    std::filesystem::path input{};   ///< {input}: the colour, a file or a folder of pictures
    std::filesystem::path frames{};  ///< {frames}: a folder of 000001.png, 000002.png, ...
    std::filesystem::path output{};  ///< {output}: a folder; {output.EXT}: depth.EXT in it
};

/// A command split into words as by a shell, with ' and " and \, and ~ for the home folder; other
/// syntax of a shell is not supported.
class EstimatorCommand {
  public:
    /// Throws InputError for an invalid command: an open quotation, an operator of a shell, no
    /// {output}, neither or both of {input} and {frames}, a place inside a longer text, an unknown
    /// place.
    explicit EstimatorCommand(std::string text);

    [[nodiscard]] const std::string& text() const noexcept { return text_; }
    /// The estimator reads separate pictures, so that finished ones need not be written again.
    [[nodiscard]] bool takes_frames() const noexcept { return takes_frames_; }
    /// The program and its arguments.
    [[nodiscard]] std::vector<std::string> words(const EstimatorPlaces& places) const;

  private:
    std::string text_;
    std::vector<std::string> words_{};
    bool takes_frames_{false};
};

}  // namespace dibhr
