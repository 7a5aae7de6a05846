// Runs it, and lays out what was flushed and what was only written.
#include "tests/app/power_cut/power_cut.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <random>
#include <set>
#include <sstream>

#include "core/files/module.hpp"
#include "tests/app/power_cut/cut_disk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test {

namespace fs = std::filesystem;

namespace {

/// Everything in the folder, itself first, held open: no inode becomes another file's meanwhile.
class OpenTree {
  public:
    explicit OpenTree(const fs::path& folder) {
        add(folder);
        for (const auto& entry : fs::recursive_directory_iterator(folder)) add(entry.path());
    }
    ~OpenTree() {
        for (const int file : files_) ::close(file);
    }
    OpenTree(const OpenTree&) = delete;
    OpenTree& operator=(const OpenTree&) = delete;

    [[nodiscard]] const std::vector<int>& files() const { return files_; }

  private:
    void add(const fs::path& file) {
        files_.push_back(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
        REQUIRE(files_.back() >= 0);
    }

    std::vector<int> files_{};
};

std::uint64_t inode_of(const fs::path& file) {
    struct stat found {};
    REQUIRE(::stat(file.c_str(), &found) == 0);
    return found.st_ino;
}

void empty(const fs::path& folder) {
    for (const auto& entry : fs::directory_iterator(folder)) fs::remove_all(entry.path());
}

}  // namespace

PowerCut::PowerCut(Work work, Work prepare) : work_(std::move(work)), prepare_(std::move(prepare)) {
    fs::create_directory(folder_ / "kept");
    fs::create_directory(disk());
    // Else each process that writes a picture or a video would load them again.
    static_cast<void>(symbol_in_module("dibhr_libav", "avformat_version"));
    static_cast<void>(symbol_in_module("dibhr_picture_codecs", "dibhr_picture_codecs"));
}

PowerCut::Work PowerCut::program(std::vector<std::string> arguments) {
    return [arguments = std::move(arguments)](const fs::path& disk) {
        std::vector<std::string> words{DIBHR_PROGRAM};
        for (const std::string& word : arguments)
            words.push_back(word.starts_with('@') ? (disk / word.substr(1)).string() : word);
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        ::setenv("LD_PRELOAD", CUT_DISK, 1);
        ::execv(pointers[0], pointers.data());
    };
}

bool PowerCut::start(const std::string& at) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::setenv("CUT_UNDER", disk().c_str(), 1);
        ::setenv("CUT_KEPT", (folder_ / "kept").c_str(), 1);
        ::setenv("CUT_AT", at.c_str(), 1);
        ::setenv("XDG_CONFIG_HOME", disk().c_str(), 1);
        const int said = ::open((folder_ / "said").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const int errors = ::open((folder_ / "errors").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        ::dup2(said, STDOUT_FILENO);
        ::dup2(errors, STDERR_FILENO);
        begin_cut();
        try {
            work_(disk());
        } catch (const std::exception& error) {
            std::cerr << error.what() << std::endl;
            ::_exit(1);
        }
        tell_steps();
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    const bool cut = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
    const bool well = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    INFO(read_text(folder_ / "errors"));
    REQUIRE((cut || well));
    return well;
}

bool PowerCut::run(int at) {
    empty(folder_ / "kept");
    empty(disk());
    prepare_(disk());
    const OpenTree before(disk());
    for (const int file : before.files()) note_flushed(file, folder_ / "kept");
    const bool ended = start(std::to_string(at));
    root_ = inode_of(disk());
    flushed_ = flushed();
    // Noted in the same way: as if all had been flushed.
    const fs::path notes = folder_ / "kept";
    const OpenTree after(disk());
    for (const int file : after.files()) note_flushed(file, notes);
    written_ = flushed();
    return ended;
}

bool PowerCut::run_again() {
    return start("-1");
}

int PowerCut::steps() const {
    return std::atoi(read_text(folder_ / "kept" / "steps").c_str());
}

int PowerCut::lines() const {
    const std::string said = read_text(folder_ / "said");
    return static_cast<int>(std::count(said.begin(), said.end(), '\n'));
}

PowerCut::Image PowerCut::flushed() const {
    Image image;
    for (const auto& note : fs::directory_iterator(folder_ / "kept")) {
        const std::uint64_t inode = std::strtoull(note.path().stem().c_str(), nullptr, 10);
        if (note.path().extension() == ".bytes") image.bytes[inode] = read_text(note.path());
        if (note.path().extension() != ".names") continue;
        auto& names = image.names[inode];
        std::istringstream lines(read_text(note.path()));
        Entry entry;
        char kind = 0;
        for (std::string name; lines >> entry.inode >> kind && std::getline(lines, name);) {
            entry.folder = kind == 'd';
            names[name.substr(1)] = entry;
        }
    }
    return image;
}

void PowerCut::come_back(Lost lost, unsigned chance) {
    empty(disk());
    std::mt19937 random(chance);
    lay(root_, disk(), lost, [&random] { return random() % 2 == 0; });
}

void PowerCut::lay(std::uint64_t inode, const fs::path& place, Lost lost,
                   const std::function<bool()>& is_kept) const {
    const auto names_of = [inode](const Image& image) {
        const auto found = image.names.find(inode);
        return found == image.names.end() ? std::map<std::string, Entry>{} : found->second;
    };
    const auto before = names_of(flushed_);
    const auto after = names_of(written_);
    std::set<std::string> names;
    for (const auto* const list : {&before, &after})
        for (const auto& [name, entry] : *list) names.insert(name);
    for (const std::string& name : names) {
        const auto& list =
            lost == Lost::contents || (lost == Lost::some && is_kept()) ? after : before;
        const auto found = list.find(name);
        if (found == list.end()) continue;
        if (!found->second.folder) {
            write_text(place / name, content(found->second.inode, lost, is_kept));
            fs::permissions(place / name, fs::perms::owner_all);  // of scripts, too
            continue;
        }
        fs::create_directory(place / name);
        lay(found->second.inode, place / name, lost, is_kept);
    }
}

std::string PowerCut::content(std::uint64_t inode, Lost lost,
                              const std::function<bool()>& is_kept) const {
    constexpr std::size_t kPage = 4096;
    const auto bytes_of = [inode](const Image& image) {
        const auto found = image.bytes.find(inode);
        return found == image.bytes.end() ? std::string() : found->second;
    };
    std::string bytes = bytes_of(flushed_);
    const std::string after = bytes_of(written_);
    if (lost == Lost::all) return bytes;
    if (lost == Lost::contents) {
        bytes.resize(std::max(bytes.size(), after.size()));
        return bytes;
    }
    if (is_kept()) bytes.resize(after.size());
    for (std::size_t at = 0; at < std::min(bytes.size(), after.size()); at += kPage)
        if (is_kept())
            bytes.replace(at, kPage, after.substr(at, std::min(kPage, bytes.size() - at)));
    return bytes;
}

FileTree PowerCut::files() const {
    FileTree tree;
    for (const auto& entry : fs::recursive_directory_iterator(disk()))
        if (entry.is_regular_file())
            tree[entry.path().lexically_relative(disk()).string()] = read_text(entry.path());
    return tree;
}

}  // namespace dibhr::test
