// The command line of a depth estimator as a person wrote it, with places for files in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dibhr {

/// What stands in the places of a command.
struct EstimatorPlaces {
    std::filesystem::path input{};   ///< {input}: the colour, a file or a folder of pictures
    std::filesystem::path frames{};  ///< {frames}: a folder of 000001.png, 000002.png, ...
    std::filesystem::path output{};  ///< {output}: a folder; {output.EXT}: depth.EXT in it
};

/// Split into words as a shell does it, with ' and " and \, and ~ for the home folder; nothing else
/// of a shell is known.
class EstimatorCommand {
  public:
    /// Throws InputError for what cannot be a command: an open quotation, what only a shell
    /// understands, no {output}, neither or both of {input} and {frames}, a place inside a longer
    /// text, a place of another name.
    explicit EstimatorCommand(std::string text);

    [[nodiscard]] const std::string& text() const noexcept { return text_; }
    /// It takes pictures, one by one, so that those it has done need not be given again.
    [[nodiscard]] bool takes_frames() const noexcept { return takes_frames_; }
    /// The program and its arguments.
    [[nodiscard]] std::vector<std::string> words(const EstimatorPlaces& places) const;

  private:
    std::string text_;
    std::vector<std::string> words_{};
    bool takes_frames_{false};
};

}  // namespace dibhr
