// One small TOML file a media, named by its path.
#include "app/settings/file_memory.hpp"

#include <toml++/toml.h>

#include <cmath>
#include <sstream>
#include <system_error>

#include "app/settings/recent_files.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/parameters.hpp"
#include "core/video/sources/kept_choices.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// The number of that name; nothing: missing or out of range.
std::optional<double> number_within(const toml::table& table, const char* name, double lowest,
                                    double highest) {
    const auto read = table[name].value<double>();
    return read && *read >= lowest && *read <= highest ? read : std::nullopt;
}

}  // namespace

fs::path file_memories_path() {
    return recent_files_path().parent_path() / "files";
}

FileMemory read_memory(const fs::path& folder, const fs::path& media) try {
    constexpr double kLongest_s = 1e6;
    const fs::path file = kept_choice_of(folder, media);
    std::error_code unknown;
    if (!fs::is_regular_file(file, unknown)) return {};
    const toml::table table = toml::parse_file(file.string());
    const TouchNumber& relief = *touch_number("relief");
    return {number_within(table, "relief", relief.lowest, relief.highest),
            table["view"].value_or(std::string{}),
            number_within(table, "at", 0.0, kLongest_s).value_or(0.0)};
} catch (const toml::parse_error&) {
    return {};
}

void keep_memory(const fs::path& folder, const fs::path& media, const FileMemory& memory) {
    const fs::path file = kept_choice_of(folder, media);
    std::error_code failed;  // reported when the file is opened
    if (memory == FileMemory{}) {
        fs::remove(file, failed);
        return;
    }
    make_folders(folder, failed);
    OutputFile out(file);
    out.write("# What dibhr remembers of " + shown(media) + "; delete it to forget.\n");
    if (memory.relief_px) out.write("relief = " + number_text(*memory.relief_px) + "\n");
    if (!memory.view.empty()) {
        std::ostringstream quoted;
        quoted << toml::value<std::string>(memory.view);
        out.write("view = " + quoted.str() + "\n");
    }
    if (memory.at_s > 0.0) out.write("at = " + number_text(memory.at_s) + "\n");
    out.commit();
}

}  // namespace dibhr
