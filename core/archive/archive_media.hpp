// The media that archived sessions touched: their list, and their copies.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/files/content_hash.hpp"

namespace dibhr {

/// The files that sessions name, each content once.
class ArchiveMedia {
  public:
    static constexpr const char* kFolder = "stimuli";

    /// How an archived session names that file: relative to its own folder. `session`: the original
    /// session or study, beside which the file may be.
    [[nodiscard]] std::string name_for(const FileContent& media,
                                       const std::filesystem::path& session);

    /// Copies every file whose bytes have the recorded sum into the archive. Returns a sentence for
    /// each that was not. Calls `progress` with a share from 0 to 1. Throws InputError when the
    /// archive cannot be written.
    std::vector<std::string> copy(const std::filesystem::path& archive,
                                  const std::function<void(double)>& progress);

    /// Writes the list and its dictionary. Throws InputError.
    void write_list(const std::filesystem::path& archive) const;

  private:
    struct Medium {
        std::string name{};
        FileContent content{};
        std::vector<std::filesystem::path> places{};  ///< where it may be
        bool copied{false};
    };

    std::vector<Medium> all_{};
};

}  // namespace dibhr
