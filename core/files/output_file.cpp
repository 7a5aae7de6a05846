// An output file, or a folder of them, that appears whole or not at all.
#include "core/files/output_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/new_folder.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/write_failure.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPart = ".part";
constexpr pid_t kMostPid = 1 << 22;  // proc(5), pid_max

void remove_empty(const std::vector<fs::path>& folders) {
    std::error_code not_empty;
    for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) {
        fs::remove(*folder, not_empty);
    }
}

/// False, and why in errno: EEXIST when there is a file of that name.
bool rename_to_new(const fs::path& from, const fs::path& to) {
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0)
        return true;
    if (errno != EINVAL && errno != ENOSYS) return false;
    // The file system has no atomic rename: another program may come between the two steps.
    std::error_code ignored;
    if (fs::exists(fs::symlink_status(to, ignored))) {
        errno = EEXIST;
        return false;
    }
    return ::rename(from.c_str(), to.c_str()) == 0;
}

/// The process that writes a file of that name, "mine.csv.part1234-0", or SQLite's beside it; 0:
/// not such a name.
pid_t writer_of(const std::string& name, const std::string& begin) {
    if (!name.starts_with(begin)) return 0;
    pid_t writer = 0;
    std::size_t digits = begin.size();
    for (; digits < name.size() && name[digits] >= '0' && name[digits] <= '9'; ++digits)
        writer = writer > kMostPid ? writer : 10 * writer + (name[digits] - '0');
    if (digits + 1 >= name.size() || name[digits] != '-') return 0;
    const std::size_t end = name.find_first_not_of("0123456789", digits + 1);
    const std::string rest = end == std::string::npos ? "" : name.substr(end);
    const bool is_ours = rest.empty() || rest == "-wal" || rest == "-shm" || rest == "-journal";
    return is_ours && end != digits + 1 ? writer : 0;
}

/// Removes the unfinished files, or folders, of programs that were killed while they wrote this
/// target. A file of another machine or container, whose process numbers mean nothing here, is
/// locked by its writer.
void remove_left_over(const fs::path& target, fs::file_type kind) {
    std::error_code failed;
    const std::string begin = target.filename().string() + kPart;
    for (const auto& entry :
         fs::directory_iterator(target.has_parent_path() ? target.parent_path() : ".", failed)) {
        const pid_t writer = writer_of(entry.path().filename().string(), begin);
        if (writer <= 0 || ::kill(writer, 0) == 0 || errno != ESRCH) continue;
        if (entry.symlink_status(failed).type() != kind) continue;
        const int left = ::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
        if (left < 0) continue;
        std::error_code kept;
        const bool removed = ::flock(left, LOCK_EX | LOCK_NB) == 0 &&
                             fs::remove_all(entry.path(), kept) > 0 && !kept;
        ::close(left);
        if (removed)
            print_warning("removed " + entry.path().string() +
                          ", which a program that was killed had left unfinished");
    }
}

}  // namespace

bool flush_to_disk(int file) noexcept {
    while (::fsync(file) != 0) {
        if (errno == EINTR) continue;
        return errno == EINVAL || errno == ENOTSUP || errno == EROFS;  // cannot be flushed
    }
    return true;
}

bool flush_folder(const fs::path& folder) noexcept {
    const char* const name = folder.empty() ? "." : folder.c_str();
    const int opened = ::open(name, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened < 0) return errno == EACCES;  // a folder that cannot be listed
    const bool done = flush_to_disk(opened);
    const int why = errno;
    ::close(opened);
    errno = why;
    return done;
}

std::vector<fs::path> make_folders(const fs::path& folder, std::error_code& failed) {
    std::vector<fs::path> missing, made;
    fs::path part = fs::absolute(folder, failed).lexically_normal();
    if (!part.has_filename()) part = part.parent_path();  // "report/"
    for (; !part.empty() && !fs::exists(part, failed) && !failed; part = part.parent_path()) {
        missing.insert(missing.begin(), part);
    }
    for (const fs::path& one : missing) {
        if (failed) break;
        if (!fs::create_directory(one, failed)) continue;
        made.push_back(one);
        if (!flush_folder(one.parent_path())) failed.assign(errno, std::generic_category());
    }
    if (!failed && !fs::is_directory(folder, failed) && !failed)
        failed = std::make_error_code(std::errc::not_a_directory);
    return made;
}

OutputFile::OutputFile(const fs::path& target) : target_(target) {
    if (target == "-") {
        file_ = STDOUT_FILENO;
        return;
    }
    owned_ = true;
    std::error_code ignored;
    const fs::file_status status = fs::status(target, ignored);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        file_ = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
        if (file_ < 0) fail("cannot be written");
        return;
    }
    // A link stays a link: what it points to is replaced.
    constexpr int kMostLinks = 40;
    for (int links = 0; links < kMostLinks && fs::is_symlink(target_, ignored); ++links) {
        target_ = target_.parent_path() / fs::read_symlink(target_, ignored);
    }
    remove_left_over(target_, fs::file_type::regular);
    // Not mkostemp(), whose files only their owner may read. Another program that was killed may
    // have left a file of such a name.
    constexpr int kMostLeftOver = 1000;
    for (int number = 0; file_ < 0 && number < kMostLeftOver; ++number) {
        temporary_ = target_;
        temporary_ += kPart + std::to_string(::getpid()) + "-" + std::to_string(number);
        file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file_ < 0 && errno != EEXIST) break;
    }
    if (file_ < 0) {
        temporary_.clear();
        fail("cannot be written");
    }
    ::flock(file_, LOCK_EX | LOCK_NB);  // remove_left_over() skips a locked file
}

OutputFile::~OutputFile() {
    if (owned_ && file_ >= 0) ::close(file_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file_, bytes.data(), bytes.size());
        if (written < 0) {
            if (errno == EINTR) continue;
            if (errno == EPIPE) throw OutputClosed{};
            fail("cannot be written");
        }
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

/// Flushes the file before it takes the target's name: a power cut must leave one of the two.
void OutputFile::close() {
    const int file = std::exchange(file_, -1);
    const bool on_disk = temporary_.empty() || flush_to_disk(file);
    const int why = errno;
    if (::close(file) != 0) fail("cannot be written");
    errno = why;
    if (!on_disk) fail("cannot be written");
}

/// Makes the new name survive a power cut.
void OutputFile::finish_rename() {
    temporary_.clear();
    if (!flush_folder(target_.parent_path())) fail("cannot be written");
}

void OutputFile::commit() {
    if (!owned_) return;
    close();
    if (temporary_.empty()) return;
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot be replaced");
    finish_rename();
}

fs::path OutputFile::commit_beside() {
    if (!owned_ || temporary_.empty()) {
        commit();
        return target_;
    }
    close();
    constexpr int kMostBeside = 10000;
    const fs::path wanted = target_;
    for (int number = 2; !rename_to_new(temporary_, target_); ++number) {
        if (errno != EEXIST || number > kMostBeside) fail("cannot be written");
        target_.replace_filename(wanted.stem().string() + "-" + std::to_string(number) +
                                 wanted.extension().string());
    }
    finish_rename();
    return target_;
}

void OutputFile::fail(const char* what) const {
    const int error = errno;
    const std::string name = owned_ ? target_.string() : "standard output";
    throw InputError(name + ": " + write_failure(error, what));
}

void write_file(const fs::path& target, std::string_view bytes) {
    OutputFile out(target);
    out.write(bytes);
    out.commit();
}

NewFolder::NewFolder(const fs::path& target)
    : target_(target.has_filename() ? target : target.parent_path()) {
    std::error_code failed;
    if (fs::exists(fs::symlink_status(target_, failed)) &&
        !(fs::is_directory(target_, failed) && fs::is_empty(target_, failed)))
        throw InputError(target_.string() +
                         ": is there already, and nothing is replaced; name a folder that is new");
    remove_left_over(target_, fs::file_type::directory);
    for (int number = 0; temporary_.empty(); ++number) {
        fs::path name = target_;
        name += kPart + std::to_string(::getpid()) + "-" + std::to_string(number);
        if (fs::create_directory(name, failed)) temporary_ = name;
        if (failed) fail(failed.value());
    }
    lock_ = ::open(temporary_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    ::flock(lock_, LOCK_EX | LOCK_NB);  // as in OutputFile
}

NewFolder::~NewFolder() {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
    if (lock_ >= 0) ::close(lock_);
}

void NewFolder::commit() {
    if (!flush_folder(temporary_)) fail(errno);
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
    temporary_.clear();
    if (!flush_folder(target_.parent_path())) fail(errno);
}

void NewFolder::fail(int error) const {
    throw InputError(target_.string() + ": " + write_failure(error, "cannot be made"));
}

OutputFolder::OutputFolder(const fs::path& folder, std::vector<std::string> names)
    : folder_(folder), names_(std::move(names)) {
    std::error_code failed;
    made_ = make_folders(folder_, failed);
    try {
        if (failed)
            throw InputError(folder_.string() + ": " +
                             write_failure(failed.value(), "cannot take files"));
        for (const std::string& name : names_) {
            std::error_code ignored;
            const fs::file_status status = fs::status(folder_ / name, ignored);
            if (fs::exists(status) && !fs::is_regular_file(status)) {
                throw InputError(
                    (folder_ / name).string() +
                    " is in the way: it is not a file that could be replaced; move it or "
                    "choose another folder");
            }
        }
        const OutputFile probe(folder_ / ".dibhr-probe");  // leaves nothing: never committed
    } catch (...) {
        remove_empty(made_);
        throw;
    }
}

OutputFolder::~OutputFolder() {
    files_.clear();
    remove_empty(made_);  // not those with committed files
}

void OutputFolder::add(const std::string& name, std::string_view bytes) {
    if (!added_.insert(name).second) return;
    auto file = std::make_unique<OutputFile>(folder_ / name);
    file->write(bytes);
    files_.push_back(std::move(file));
}

void OutputFolder::commit() {
    for (const auto& file : files_) file->commit();
    files_.clear();
    made_.clear();
    for (const std::string& name : names_) {
        std::error_code ignored;  // a file of an earlier run that could not be removed
        if (!added_.contains(name)) fs::remove(folder_ / name, ignored);
    }
}

}  // namespace dibhr
