// Folders named by hashes, each with a lock and a record.
#include "core/estimate/depth_cache.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/estimate/estimator_output.hpp"
#include "core/files/content_hash.hpp"
#include "core/files/json.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/video/sources/sidecar.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kVersion = 1;
constexpr const char* kRecord = "estimate.json";
constexpr const char* kLock = "lock";

std::string name_for(const std::string& colour_sha256, const std::string& command) {
    constexpr std::size_t kDigits = 32;
    const std::string both = colour_sha256 + "\n" + command;
    const std::vector<std::uint8_t> bytes(both.begin(), both.end());
    return sha256_of(bytes).substr(0, kDigits);
}

[[noreturn]] void refuse_folder(const fs::path& folder, const std::string& why) {
    throw InputError("estimated depth cannot be kept in " + shown(folder) + " (" + why +
                     "): make it writable, or let XDG_CACHE_HOME name another folder");
}

/// Locks the folder. Returns the descriptor; negative: another program has the lock.
int locked(const fs::path& folder) {
    const int lock = ::open((folder / kLock).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (lock < 0) refuse_folder(folder, std::strerror(errno));
    if (::flock(lock, LOCK_EX | LOCK_NB) == 0) return lock;
    ::close(lock);
    return -1;
}

std::optional<EstimateRecord> record_in(const fs::path& folder) try {
    std::ifstream in(folder / kRecord, std::ios::binary);
    if (!in) return std::nullopt;
    const Json json = parsed_json(std::string(std::istreambuf_iterator<char>(in), {}));
    if (json.at("version") != kVersion) return std::nullopt;
    EstimateRecord record;
    record.colour.file = json.at("colour").get<std::string>();
    record.colour.columns = json.at("columns");
    record.colour.rows = json.at("rows");
    record.colour.still = json.at("still");
    record.colour.start_s = json.at("start_s");
    record.colour.times_s = json.at("times_s").get<std::vector<double>>();
    record.command = json.at("command");
    record.depth = json.at("depth");
    record.sha256 = json.value("sha256", std::string());  // none in older ones
    record.levels = statement_in(json.at("levels"), kRecord);
    record.said = statement_in(json.at("said"), kRecord);
    const bool whole =
        !record.colour.times_s.empty() && record.colour.columns > 0 && record.colour.rows > 0;
    return whole ? std::optional(record) : std::nullopt;
} catch (const std::exception&) {  // of another version, truncated or no record: estimate again
    return std::nullopt;
}

/// Ignores a failure to remove: a later write to that place reports it.
void clear_away(const fs::path& place) {
    std::error_code failed;
    fs::remove_all(place, failed);
}

}  // namespace

EstimateFolder::EstimateFolder(const fs::path& cache, const std::string& colour_sha256,
                               const std::string& command)
    : path_(cache / name_for(colour_sha256, command)) {
    std::error_code failed;
    make_folders(path_, failed);
    if (failed) refuse_folder(path_, failed.message());
    lock_ = locked(path_);
    if (lock_ < 0)
        throw InputError(
            "another dibhr is making this depth already: wait for it, or end it there");
}

EstimateFolder::~EstimateFolder() {
    ::close(lock_);
}

std::optional<EstimateRecord> EstimateFolder::record() const {
    return record_in(path_);
}

void EstimateFolder::keep(const EstimateRecord& record) const {
    const ColourFrames& colour = record.colour;
    const Json json{{"version", kVersion},
                    {"colour", colour.file.string()},
                    {"columns", colour.columns},
                    {"rows", colour.rows},
                    {"still", colour.still},
                    {"start_s", colour.start_s},
                    {"times_s", colour.times_s},
                    {"command", record.command},
                    {"depth", record.depth},
                    {"sha256", record.sha256},
                    {"levels", toml_of(record.levels)},
                    {"said", toml_of(record.said)}};
    write_file(path_ / kRecord, json_text(json));
}

void EstimateFolder::empty() const {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(path_, failed))
        if (entry.path().filename() != kLock) clear_away(entry.path());
}

void EstimateFolder::remove_work_files() const {
    clear_away(frames());
    clear_away(output());
}

std::vector<KeptEstimate> kept_estimates(const fs::path& cache) {
    std::vector<KeptEstimate> all;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(cache, none)) {
        KeptEstimate kept{.folder = entry.path()};
        if (const auto record = record_in(kept.folder)) {
            kept.record = *record;
            kept.frames_there = record->depth.empty() ? row_so_far(kept.folder / "output").size()
                                                      : record->colour.count();
        }
        kept.bytes = bytes_in(kept.folder);
        all.push_back(std::move(kept));
    }
    std::sort(all.begin(), all.end(), [](const KeptEstimate& a, const KeptEstimate& b) {
        return in_natural_order(a.record.colour.file.string(), b.record.colour.file.string());
    });
    return all;
}

bool forget_estimate(const KeptEstimate& kept) {
    const int lock = locked(kept.folder);
    if (lock < 0) return false;
    std::error_code failed;
    fs::remove_all(kept.folder, failed);
    ::close(lock);
    if (failed)
        throw InputError(shown(kept.folder) + " cannot be removed (" + failed.message() +
                         "): make it writable");
    return true;
}

}  // namespace dibhr
