// Reads bytes of arrays from a file, or from a zip archive.
#include "core/video/formats/array_bytes.hpp"

#include <zip.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".npy";
constexpr std::uint64_t kMostDeflated = 1032;  // bytes that one byte can unpack to
constexpr std::uint64_t kMostPacked = 100;     // the same for large arrays, which unpack slowly

[[noreturn]] void refuse_as_cut(const fs::path& file) {
    throw InputError(shown(file) + " is cut off or damaged: copy it or save it again");
}

class FileBytes : public ArrayBytes {
  public:
    explicit FileBytes(const fs::path& file)
        : file_(file), in_(file, std::ios::binary), size_(size_of(file)) {}

    [[nodiscard]] std::uint64_t size() const override { return size_; }

    void read(std::uint64_t at, std::span<std::uint8_t> into) override {
        in_.clear();
        in_.seekg(static_cast<std::streamoff>(at));
        in_.read(reinterpret_cast<char*>(into.data()), static_cast<std::streamsize>(into.size()));
        if (!in_) refuse_as_cut(file_);
    }

  private:
    fs::path file_;
    std::ifstream in_;
    std::uint64_t size_;
};

class ZippedBytes : public ArrayBytes {
  public:
    ZippedBytes(fs::path file, std::shared_ptr<zip> archive, const std::string& entry)
        : file_(std::move(file)), archive_(std::move(archive)) {
        zip_stat_t stat{};
        if (zip_stat(archive_.get(), entry.c_str(), 0, &stat) != 0) refuse_as_cut(file_);
        stored_ = stat.comp_method == ZIP_CM_STORE;
        if (!stored_ && stat.comp_method != ZIP_CM_DEFLATE)
            throw InputError(shown(file_) + " is packed in an unknown way: save it by numpy.savez");
        if (stat.comp_size > size_of(file_) || stat.size / kMostDeflated > stat.comp_size)
            refuse_as_cut(file_);
        if (stat.size / kMostPacked > stat.comp_size && stat.size > kMostPictureBytes)
            throw InputError(shown(file_) + " unpacks to " + std::to_string(stat.size >> 20U) +
                             " MB out of a few bytes: save it by numpy.savez, without compression");
        index_ = stat.index;
        size_ = stat.size;
    }

    [[nodiscard]] std::uint64_t size() const override { return size_; }

    void read(std::uint64_t at, std::span<std::uint8_t> into) override {
        go_to(at);
        take(into);
    }

  private:
    struct Closer {
        void operator()(zip_file_t* opened) const noexcept { zip_fclose(opened); }
    };

    void go_to(std::uint64_t at) {
        if (opened_ == nullptr || at < at_) {
            opened_.reset(zip_fopen_index(archive_.get(), index_, 0));
            if (opened_ == nullptr) refuse_as_cut(file_);
            at_ = 0;
        }
        if (stored_ && zip_fseek(opened_.get(), static_cast<zip_int64_t>(at), SEEK_SET) == 0)
            at_ = at;
        std::array<std::uint8_t, 65536> passed{};
        while (at_ < at) take(std::span(passed).first(std::min<std::uint64_t>(at - at_, 65536)));
    }

    void take(std::span<std::uint8_t> into) {
        while (!into.empty()) {
            const auto count = zip_fread(opened_.get(), into.data(), into.size());
            if (count <= 0) {
                opened_.reset();
                refuse_as_cut(file_);
            }
            at_ += static_cast<std::uint64_t>(count);
            into = into.subspan(static_cast<std::size_t>(count));
        }
    }

    fs::path file_;
    std::shared_ptr<zip> archive_;
    zip_uint64_t index_{0};
    std::uint64_t size_{0};
    bool stored_{false};
    std::unique_ptr<zip_file_t, Closer> opened_{};
    std::uint64_t at_{0};
};

std::shared_ptr<zip> opened_archive(const fs::path& file) {
    zip_t* const archive = zip_open(file.c_str(), ZIP_RDONLY, nullptr);
    return archive == nullptr ? nullptr : std::shared_ptr<zip>(archive, zip_discard);
}

std::vector<std::string> names_in(zip& archive) {
    std::vector<std::string> names;
    const zip_int64_t count = zip_get_num_entries(&archive, 0);
    for (zip_int64_t k = 0; k < count; ++k) {
        const char* const entry = zip_get_name(&archive, static_cast<zip_uint64_t>(k), 0);
        const std::string_view name = entry == nullptr ? std::string_view() : entry;
        if (name.ends_with(kEnding)) names.emplace_back(name.substr(0, name.size() - 4));
    }
    return names;
}

}  // namespace

bool is_npy(std::string_view head) {
    return head.starts_with("\x93NUMPY");
}

bool is_npz(const fs::path& file, std::string_view head) {
    if (!head.starts_with("PK\3\4")) return false;
    const auto archive = opened_archive(file);
    return archive != nullptr && !names_in(*archive).empty();
}

NamedArrays::NamedArrays(fs::path file) : file_(std::move(file)) {
    if (is_npy(head_of(file_))) {
        names_.emplace_back();
        return;
    }
    archive_ = opened_archive(file_);
    if (archive_ == nullptr) refuse_as_cut(file_);
    names_ = names_in(*archive_);
}

std::unique_ptr<ArrayBytes> NamedArrays::open(const std::string& name) const {
    if (archive_ == nullptr) return std::make_unique<FileBytes>(file_);
    return std::make_unique<ZippedBytes>(file_, archive_, name + std::string(kEnding));
}

}  // namespace dibhr
