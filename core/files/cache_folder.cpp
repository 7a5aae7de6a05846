// Folders named by hashes, each with a lock, whose time tells when it was used.
#include "core/files/cache_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <system_error>

#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr const char* kLock = "lock";

std::string name_for(const std::string& key) {
    constexpr std::size_t kDigits = 32;
    const std::vector<std::uint8_t> bytes(key.begin(), key.end());
    return sha256_of(bytes).substr(0, kDigits);
}

[[noreturn]] void refuse_folder(const fs::path& folder, const std::string& what,
                                const std::string& why) {
    throw InputError(what + " cannot be kept in " + shown(folder) + " (" + why +
                     "): make it writable, or let XDG_CACHE_HOME name another folder");
}

/// Locks the folder. Returns the descriptor; negative: another program has the lock.
int locked(const fs::path& folder, const std::string& what) {
    const int lock = ::open((folder / kLock).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (lock < 0) refuse_folder(folder, what, std::strerror(errno));
    if (::flock(lock, LOCK_EX | LOCK_NB) == 0) return lock;
    ::close(lock);
    return -1;
}

}  // namespace

CacheFolder::CacheFolder(const fs::path& cache, const std::string& key, const std::string& what,
                         const std::string& busy)
    : path_(cache / name_for(key)) {
    std::error_code failed;
    make_folders(path_, failed);
    if (failed) refuse_folder(path_, what, failed.message());
    lock_ = locked(path_, what);
    if (lock_ < 0) throw InputError(busy);
}

CacheFolder::~CacheFolder() {
    ::close(lock_);
}

void CacheFolder::empty() const {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(path_, failed))
        if (entry.path().filename() != kLock) clear_away(entry.path());
}

std::vector<fs::path> cache_folders(const fs::path& cache) {
    std::vector<fs::path> all;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(cache, none)) all.push_back(entry.path());
    return all;
}

void note_use(const fs::path& folder) noexcept {
    std::error_code failed;  // of a cache that cannot be written
    fs::last_write_time(folder / kLock, fs::file_time_type::clock::now(), failed);
}

fs::file_time_type last_use(const fs::path& folder) noexcept {
    std::error_code failed;
    const fs::file_time_type used = fs::last_write_time(folder / kLock, failed);
    return failed ? fs::file_time_type::min() : used;
}

bool remove_cache_folder(const fs::path& folder, const std::string& what) {
    const int lock = locked(folder, what);
    if (lock < 0) return false;
    std::error_code failed;
    fs::remove_all(folder, failed);
    ::close(lock);
    if (failed)
        throw InputError(shown(folder) + " cannot be removed (" + failed.message() +
                         "): make it writable");
    return true;
}

std::uintmax_t bytes_in(const fs::path& folder) noexcept {
    std::uintmax_t bytes = 0;
    std::error_code failed;
    for (fs::recursive_directory_iterator at(folder, failed), end; !failed && at != end;
         at.increment(failed)) {
        std::error_code gone;
        const std::uintmax_t size = at->is_regular_file(gone) ? at->file_size(gone) : 0;
        if (!gone) bytes += size;
    }
    return bytes;
}

void clear_away(const fs::path& place) noexcept {
    std::error_code failed;
    fs::remove_all(place, failed);
}

}  // namespace dibhr
