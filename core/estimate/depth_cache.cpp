// Folders named by hashes, each with a lock and a record.
#include "core/estimate/depth_cache.hpp"

#include <algorithm>
#include <exception>
#include <fstream>
#include <iterator>
#include <utility>

#include "core/estimate/estimator_output.hpp"
#include "core/files/json.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/video/sources/sidecar.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kVersion = 1;
constexpr const char* kRecord = "estimate.json";
constexpr const char* kWhat = "estimated depth";

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

}  // namespace

EstimateFolder::EstimateFolder(const fs::path& cache, const std::string& colour_sha256,
                               const std::string& command)
    : folder_(cache, colour_sha256 + "\n" + command, kWhat,
              "another dibhr is making this depth already: wait for it, or end it there") {}

std::optional<EstimateRecord> EstimateFolder::record() const {
    return record_in(path());
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
    write_file(path() / kRecord, json_text(json));
}

void EstimateFolder::remove_work_files() const {
    clear_away(frames());
    clear_away(output());
}

std::vector<KeptEstimate> kept_estimates(const fs::path& cache) {
    std::vector<KeptEstimate> all;
    for (const fs::path& folder : cache_folders(cache)) {
        KeptEstimate kept{.folder = folder};
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
    return remove_cache_folder(kept.folder, kWhat);
}

}  // namespace dibhr
