// What a disk has of files and folders, noted by the one whose power is cut and by the test.
#pragma once

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <fstream>
#include <string>

namespace dibhr::test {

/// From here on this process's disk is the one that the variables $CUT_... tell of: of the files
/// under $CUT_UNDER it notes in the folder $CUT_KEPT what has been flushed, of a file in
/// "INODE.bytes", of a folder in "INODE.names". Before step $CUT_AT to the disk (a write, a flush,
/// a change of names; counted from 0) the process is killed.
void begin_cut();
/// How many steps there were, in "steps".
void tell_steps();

/// All of an open file, wherever it is read.
inline std::string bytes_in(int file) {
    std::string bytes;
    std::array<char, 65536> piece{};
    for (ssize_t got = 0;
         (got = pread(file, piece.data(), piece.size(), static_cast<off_t>(bytes.size()))) > 0;)
        bytes.append(piece.data(), static_cast<std::size_t>(got));
    return bytes;
}

/// A line for each name in an open folder: inode, 'd' for a folder, name.
inline std::string names_in(int folder) {
    std::string lines;
    DIR* const entries = opendir(("/proc/self/fd/" + std::to_string(folder)).c_str());
    while (const dirent* const entry = entries != nullptr ? readdir(entries) : nullptr) {
        const std::string name(entry->d_name);
        if (name == "." || name == "..") continue;
        struct stat found {};
        if (fstatat(folder, entry->d_name, &found, AT_SYMLINK_NOFOLLOW) != 0) continue;
        lines +=
            std::to_string(found.st_ino) + (S_ISDIR(found.st_mode) ? " d " : " f ") + name + "\n";
    }
    if (entries != nullptr) closedir(entries);
    return lines;
}

/// In the folder `kept`: the disk has all that this open file, or folder, holds now.
inline void note_flushed(int file, const std::string& kept) {
    struct stat found {};
    if (fstat(file, &found) != 0) return;
    const bool folder = S_ISDIR(found.st_mode);
    std::ofstream note(kept + "/" + std::to_string(found.st_ino) + (folder ? ".names" : ".bytes"),
                       std::ios::binary);
    note << (folder ? names_in(file) : bytes_in(file));
}

}  // namespace dibhr::test
