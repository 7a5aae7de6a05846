// Finds files in folders, and names their results.
#include "app/commands/batch/given_files.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <set>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/session/session_schema.hpp"
#include "core/sqlite/database.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

/// SQLite's file format, section 1.3: 4 bytes at 68, big-endian.
std::int64_t application_of(const fs::path& file) {
    constexpr std::streamoff kPlace = 68;
    std::array<char, 4> bytes{};
    std::ifstream stream(file, std::ios::binary);
    if (!stream.seekg(kPlace).read(bytes.data(), bytes.size())) return 0;
    std::int64_t number = 0;
    for (const char byte : bytes) number = number << 8 | static_cast<unsigned char>(byte);
    return number;
}

bool is_sought(const fs::directory_entry& entry, const SoughtFiles& sought) {
    std::error_code failed;
    if (!entry.is_regular_file(failed)) return false;
    if (entry.path().extension() == sought.ending) return true;
    return sought.application_id != 0 && is_database(entry.path()) &&
           application_of(entry.path()) == sought.application_id;
}

/// Calls `take` with each until that is false.
template <typename Take>
void visit_sought(const fs::path& folder, const SoughtFiles& sought, const Take& take) {
    try {
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (is_sought(entry, sought) && !take(entry.path())) return;
    } catch (const fs::filesystem_error& error) {
        throw InputError(error.path1().string() + ": cannot be listed (" + error.code().message() +
                         "); make it readable, or name its files");
    }
}

std::string without_ending(const fs::path& path, const SoughtFiles& sought) {
    return (path.extension() == sought.ending ? fs::path(path).replace_extension() : path)
        .generic_string();
}

/// Gives each file a name of its own.
class Files {
  public:
    void add(const fs::path& file, const std::string& name) {
        std::string own = name;
        for (int number = 2; !names_.insert(own).second; ++number)
            own = name + '-' + std::to_string(number);
        files_.push_back({file, std::move(own)});
    }

    [[nodiscard]] std::vector<GivenFile> take() { return std::move(files_); }

  private:
    std::vector<GivenFile> files_{};
    std::set<std::string> names_{};
};

}  // namespace

SoughtFiles sought_sessions() {
    return {.ending = ".dibhr", .application_id = kSessionApplicationId, .called = "session"};
}

bool are_many(const std::vector<fs::path>& given) {
    std::error_code missing;
    return given.size() > 1 || (given.size() == 1 && fs::is_directory(given.front(), missing));
}

bool holds_sought(const fs::path& folder, const SoughtFiles& sought) {
    bool found = false;
    visit_sought(folder, sought, [&found](const fs::path&) {
        found = true;
        return false;
    });
    return found;
}

std::vector<GivenFile> given_files(const std::vector<fs::path>& given, const SoughtFiles& sought) {
    Files files;
    for (const fs::path& one : given) {
        std::error_code missing;
        if (!fs::is_directory(one, missing)) {
            files.add(one, without_ending(one.filename(), sought));
            continue;
        }
        std::vector<fs::path> found;
        visit_sought(one, sought, [&found](const fs::path& file) {
            found.push_back(file);
            return true;
        });
        if (found.empty())
            throw InputError(one.string() + ": there is no " + sought.called + " file (*" +
                             sought.ending + ") in this folder");
        std::ranges::sort(found);
        for (const fs::path& file : found)
            files.add(file, without_ending(file.lexically_relative(one), sought));
    }
    return files.take();
}

}  // namespace dibhr
