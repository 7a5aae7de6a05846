// The rows of a computed stream of touches, one line an update: a contract that scripts depend on;
// and the file that a command writes rows to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/output_file.hpp"
#include "core/haptics/touch.hpp"

namespace dibhr {

inline constexpr std::string_view kOutputHeader =
    "t,gx,gy,gz,px,py,pz,fx,fy,fz,cx,cy,cz,contact,primitive,i,j,moves,ns\n";

/// One update. Grid space [px], forces [N] in the axes of grid space.
struct OutputRow {
    double t_s{0.0};
    Touch touch{};
    std::int64_t update_ns{0};
};

/// Appends one line.
void append_row(std::string& text, const OutputRow& row);

/// Written in large pieces; appears whole or not at all, at commit().
class RowFile {
  public:
    /// "-" is standard output; an empty name writes nothing. Throws InputError when the target
    /// cannot be written, or is one of the `inputs`, which `why` says.
    RowFile(const std::filesystem::path& target, const std::vector<std::filesystem::path>& inputs,
            const std::string& why);

    [[nodiscard]] bool wanted() const noexcept { return file_.has_value(); }
    /// Rows are appended here; after each, or after a few, `rows_done`.
    [[nodiscard]] std::string& text() noexcept { return text_; }
    void rows_done();
    void commit();

  private:
    std::optional<OutputFile> file_{};
    std::string text_{};
};

}  // namespace dibhr
