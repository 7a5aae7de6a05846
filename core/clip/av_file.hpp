// What every file that libav writes needs; inside the room.
#pragma once

#include <filesystem>
#include <string>

struct AVFormatContext;

namespace dibhr {

/// Absolute and with its protocol, so that a colon in a name is no other one.
[[nodiscard]] std::string url_of(const std::filesystem::path& file);

/// Throws InputError where libav's result says that it failed.
void require_written(int result);

/// As a deleter: of a file that was not finished, too.
void close_and_free(AVFormatContext* format);

/// Of that format ("mp4", "matroska"), not yet opened.
[[nodiscard]] AVFormatContext* new_file(const std::filesystem::path& file, const char* format);

}  // namespace dibhr
