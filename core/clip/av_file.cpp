// Names, failures and ends of files that libav writes.
#include "core/clip/av_file.hpp"

extern "C" {
#include <libavformat/avformat.h>
#include <libavutil/error.h>
}

#include <array>
#include <new>
#include <system_error>

#include "core/error.hpp"

namespace dibhr {

namespace fs = std::filesystem;

/// Absolute and with its protocol, so that a colon in a name is no other one.
std::string url_of(const fs::path& file) {
    std::error_code gone;
    return "file:" + fs::absolute(file, gone).string();
}

void require_written(int result) {
    if (result >= 0) return;
    std::array<char, AV_ERROR_MAX_STRING_SIZE> reason{};
    av_strerror(result, reason.data(), reason.size());
    throw InputError("cannot be written (" + std::string(reason.data()) +
                     "); choose another folder or make room for it");
}

void close_and_free(AVFormatContext* format) {
    avio_closep(&format->pb);
    avformat_free_context(format);
}

AVFormatContext* new_file(const fs::path& file, const char* name) {
    AVFormatContext* format = nullptr;
    avformat_alloc_output_context2(&format, nullptr, name, url_of(file).c_str());
    if (format == nullptr) throw std::bad_alloc();
    return format;
}

}  // namespace dibhr
