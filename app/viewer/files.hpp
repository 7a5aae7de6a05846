// Files that the viewer makes in the current folder: their names, and pictures of the window.
#pragma once

#include <future>
#include <optional>
#include <string>
#include <vector>

#include "core/video/media.hpp"

namespace dibhr {

/// "dibhr-20261120-060742-123.ENDING" in the current folder: to the millisecond, so that no two
/// files share a name.
[[nodiscard]] std::string new_file_name(const char* ending);

/// Writes pictures away from the window's thread.
class Screenshots {
  public:
    /// Begins to write one into a new file.
    void save(ColourImage picture);

    /// What came of one that is done, for a notice. Throws InputError, once a picture.
    [[nodiscard]] std::optional<std::string> take();

    /// Waits for all. Throws InputError for the first that could not be written.
    void finish();

  private:
    std::vector<std::future<std::string>> writing_{};
};

}  // namespace dibhr
