// Copies of sessions and studies without the folders of the computer that recorded them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "core/files/content_hash.hpp"
#include "core/sqlite/database.hpp"

namespace dibhr {

/// The text with every absolute path in it as a name: "goals:/home/me/g.csv" is "goals:g.csv". A
/// path ends at a quotation mark, comma, semicolon or line break, for folders may have blanks.
[[nodiscard]] std::string without_folders(std::string_view text);

/// Copies what is in a database, and in its log unless it is `complete`, into a new file. Throws
/// InputError.
void copy_database(const std::filesystem::path& from, const std::filesystem::path& to,
                   bool complete);

/// Removes the folders in an archived session: facts keep names, files of table `media` get what
/// `name_media` says. Ticks, marks and parameters keep their bits. Nothing of the former texts is
/// left in the file's free parts. Throws InputError.
void remove_folders(const std::filesystem::path& session,
                    const std::function<std::string(const FileContent&)>& name_media);

/// The same in an archived study, whose sessions `change` is given one after the other, in the file
/// `scratch`: the number of its trial.
void remove_study_folders(const std::filesystem::path& study, const std::filesystem::path& scratch,
                          const std::function<void(int trial)>& change);

}  // namespace dibhr
