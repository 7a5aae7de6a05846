// Reads a small text whole.
#include "core/files/text_file.hpp"

#include <cstdint>
#include <fstream>
#include <sstream>
#include <system_error>

namespace dibhr {

std::optional<std::string> small_text_in(const std::filesystem::path& file) {
    constexpr std::uintmax_t kMostBytes = 1U << 20;
    std::error_code failed;
    if (!std::filesystem::is_regular_file(file, failed)) return std::nullopt;
    const std::uintmax_t bytes = std::filesystem::file_size(file, failed);
    std::ifstream in(file, std::ios::binary);
    if (failed || bytes > kMostBytes || !in) return std::nullopt;
    std::ostringstream content;
    if (bytes > 0) content << in.rdbuf();  // `<<` fails for an empty file
    if (content.fail()) return std::nullopt;
    return content.str();
}

}  // namespace dibhr
