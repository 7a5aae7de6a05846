// Finds values that protect the hand less than the defaults; the record of consent, a line each.
#include "app/settings/consent.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>
#include <system_error>

#include "app/settings/recent_files.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/text_file.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

bool protects_less(WeakerWhen weaker_when, double value, double than) {
    return weaker_when == WeakerWhen::higher ? value > than : value < than;
}

bool protects_less(WeakerWhen weaker_when, const Setting& value, const Setting& than) {
    if (weaker_when == WeakerWhen::other) return !same(value, than);
    return protects_less(weaker_when, *std::get<double*>(value.value),
                         *std::get<double*>(than.value));
}

std::string key_of(const Setting& setting) {
    return std::string(setting.table) + '.' + std::string(setting.name) + ' ';
}

std::string key_of_command(const std::string& command) {
    return "run " + escaped_text(command);
}

/// Whether the record has consent to this value, or to one that protects even less.
bool was_agreed(const std::set<std::string>& lines, const Setting& setting,
                WeakerWhen weaker_when) {
    const std::string key = key_of(setting);
    if (lines.contains(key + text_of(setting))) return true;
    if (weaker_when == WeakerWhen::other) return false;
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
        const auto agreed =
            line.starts_with(key) ? number_of_text(line.substr(key.size())) : std::nullopt;
        return agreed && protects_less(weaker_when, *agreed, *std::get<double*>(setting.value));
    });
}

/// The value as text for the user: on, off, a name, a number.
std::string value_in_words(const Setting& setting) {
    if (const bool* const* on = std::get_if<bool*>(&setting.value)) return **on ? "on" : "off";
    std::string text = text_of(setting);
    std::erase(text, '"');
    return text;
}

bool is_of(const UnsafeSetting& doubt, const Setting& setting) {
    return doubt.table == setting.table && doubt.name == setting.name;
}

/// Locks a folder against other threads and programs; no lock where the folder cannot be opened.
class FolderLock {
  public:
    explicit FolderLock(const fs::path& folder)
        : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        if (folder_ >= 0) ::flock(folder_, LOCK_EX);
    }
    ~FolderLock() {
        if (folder_ >= 0) ::close(folder_);
    }
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

  private:
    int folder_;
};

}  // namespace

fs::path consent_path() {
    return recent_files_path().parent_path() / "agreed";
}

std::vector<UnsafeSetting> Consent::replace_unsafe(Settings& settings) const {
    const std::set<std::string> lines = agreed();
    Settings usual;
    const std::vector<Setting> requested = all_settings(settings);
    const std::vector<Setting> safe = all_settings(usual);
    std::vector<UnsafeSetting> unsafe_settings;
    for (std::size_t k = 0; k < requested.size(); ++k) {
        const auto& known = requested[k].protection;
        if (!known || !protects_less(known->weaker_when, requested[k], safe[k]) ||
            was_agreed(lines, requested[k], known->weaker_when))
            continue;
        unsafe_settings.push_back({requested[k].table, requested[k].name, known->what,
                                   value_in_words(safe[k]), value_in_words(requested[k]),
                                   key_of(requested[k]) + text_of(requested[k])});
        assign(requested[k], safe[k]);
    }
    return unsafe_settings;
}

void Consent::replace_unsafe_and_warn(Settings& settings, const fs::path& file) const {
    print_warning(warning_text(replace_unsafe(settings), file));
}

bool Consent::has_agreed_to(const std::string& command) const {
    return agreed().contains(key_of_command(command));
}

void Consent::agree(const std::vector<UnsafeSetting>& unsafe_settings) const {
    std::vector<std::string> lines;
    for (const UnsafeSetting& doubt : unsafe_settings) lines.push_back(doubt.record);
    add(lines);
}

void Consent::agree(const std::string& command) const {
    add({key_of_command(command)});
}

void Consent::agree_to_changes(Settings before, Settings now) const {
    Settings held = now;
    std::vector<UnsafeSetting> unsafe_settings = replace_unsafe(held);
    const std::vector<Setting> first = all_settings(before);
    const std::vector<Setting> last = all_settings(now);
    std::erase_if(unsafe_settings, [&](const UnsafeSetting& doubt) {
        for (std::size_t k = 0; k < first.size(); ++k)
            if (is_of(doubt, first[k])) return same(first[k], last[k]);
        return true;
    });
    agree(unsafe_settings);
}

std::set<std::string> Consent::agreed() const {
    std::istringstream text(small_text_in(record_).value_or(""));
    std::set<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.insert(line);
    return lines;
}

void Consent::add(const std::vector<std::string>& lines) const {
    constexpr std::string_view kHead = "# Agreed to on this machine. Delete a line to be asked.";
    std::error_code failed;  // reported when the file is opened
    make_folders(record_.parent_path(), failed);
    const FolderLock alone(record_.parent_path());
    std::set<std::string> all = agreed();
    const std::size_t before = all.size();
    all.insert(lines.begin(), lines.end());
    if (all.size() == before) return;
    all.insert(std::string(kHead));  // "#" comes before all that is a key
    write_file(record_, listed({all.begin(), all.end()}, "\n") + '\n');
}

void copy_unsafe(const std::vector<UnsafeSetting>& unsafe_settings, Settings from, Settings& to) {
    const std::vector<Setting> source = all_settings(from);
    const std::vector<Setting> target = all_settings(to);
    for (std::size_t k = 0; k < source.size(); ++k) {
        const auto of_it = [&](const UnsafeSetting& doubt) { return is_of(doubt, source[k]); };
        if (std::any_of(unsafe_settings.begin(), unsafe_settings.end(), of_it))
            assign(target[k], source[k]);
    }
}

void drop_changed(std::vector<UnsafeSetting>& unsafe_settings, Settings now) {
    for (const Setting& setting : all_settings(now))
        std::erase_if(unsafe_settings, [&setting](const UnsafeSetting& doubt) {
            return is_of(doubt, setting) && value_in_words(setting) != doubt.usual;
        });
}

std::string warning_text(const std::vector<UnsafeSetting>& unsafe_settings, const fs::path& file) {
    if (unsafe_settings.empty()) return {};
    std::vector<std::string> values;
    for (const UnsafeSetting& doubt : unsafe_settings)
        values.push_back(std::string(doubt.what) + " " + doubt.requested + " in place of " +
                         doubt.usual);
    return file.string() + " asks for " + listed(values) +
           ": the default is used until somebody agrees in the viewer's window";
}

}  // namespace dibhr
