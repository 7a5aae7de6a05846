// What an archive says of itself.
#include "core/archive/archive_pages.hpp"

#include <algorithm>
#include <vector>

#include "core/archive/archive_layout.hpp"
#include "core/archive/dictionary.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

/// After the title and the count.
constexpr const char* kPage = R"(
Recorded and written by dibhr: people touch the surface of video with depth, and a loop at about 1 kHz computes
the force. Names follow the Brain Imaging Data Structure (BIDS) where it has a rule.

| files | what is in them |
|---|---|
| `dataset_description.json` | name, licence, authors, version of dibhr |
| `participants.tsv` | one line a participant: the label, and nothing else about the person |
| `sub-X/beh/*_ticks.csv` | one row for every update of the force |
| `sub-X/beh/*_marks.csv` | moments that were marked while recording |
| `sub-X/beh/sub-X_task-study_*_trials.csv` | a study's trials: what was felt and what was answered; `run` names the ticks |
| `*.json` beside a table | its dictionary: meaning and unit of every column; start in UTC, drift of the clock, rate, version, device, parameters |
| `sourcedata/` | the sessions (`.dibhr`) and studies (`.dibhr-study`) themselves: SQLite 3 files, which explain their columns |
| `protocols/` | the page of every study as it was run |
| `stimuli/media.csv` | the files that were touched, with their sums; those with `copied` yes are beside it |
| `manifest.sha256` | the SHA-256 of every other file |

Tables are CSV (RFC 4180, UTF-8): a line of names, then rows; an empty cell has no value. Numbers have 17
significant digits and read back to the same bits. An apostrophe before a text keeps spreadsheets from
calculating it.

    sha256sum -c manifest.sha256                 every file is as it was written
    dibhr archive --check FOLDER                 the same, and the tables agree with the sessions
    dibhr replay sourcedata/sub-X/SESSION.dibhr  computed again, where the media are in stimuli/ or beside it

## What was removed

Sessions and studies state the folders of the computer that recorded them. In these copies the folders
are removed, and the names of files stay; the names of sessions and studies are made from the labels. Ticks, marks and
parameters have the bits of the original. A protocol page with folders differs from the page whose sum the study
states. What people wrote themselves (labels, notes, marks, pages) is kept, without folders of paths: read it before you publish.
)";

std::string readme(const std::string& name, const ArchiveRequest& request,
                   const ArchiveSummary& summary) {
    return "# " + one_line(name) + "\n\n" + "Sessions: " + std::to_string(summary.sessions) +
           ". Participants: " + std::to_string(summary.participants) +
           ". Licence: " + (request.licence.empty() ? "not stated" : one_line(request.licence)) +
           ".\n" + kPage;
}

Json description(const std::string& name, const ArchiveRequest& request) {
    Json json = {{"Name", name}, {"BIDSVersion", "1.8.0"}, {"DatasetType", "raw"}};
    if (!request.licence.empty()) json["License"] = request.licence;
    if (!request.authors.empty()) json["Authors"] = request.authors;
    json["GeneratedBy"] = Json::array({{{"Name", "dibhr"}, {"Version", request.program}}});
    return json;
}

}  // namespace

void write_pages(const std::filesystem::path& archive, const ArchiveRequest& request,
                 const ArchiveSummary& summary,
                 const std::map<std::string, std::string>& participants) {
    const std::filesystem::path folder = std::filesystem::absolute(request.folder);
    const std::string name =
        !request.name.empty()
            ? request.name
            : (folder.has_filename() ? folder : folder.parent_path()).filename().string();
    write_file(archive / "dataset_description.json", json_text(description(name, request)));
    write_file(archive / "README.md", readme(name, request, summary));
    std::vector<std::string> names;
    for (const auto& [label, one] : participants) names.push_back(one);
    std::ranges::sort(names);
    std::string rows = "participant_id\n";
    for (const std::string& one : names) rows += one + "\n";
    write_file(archive / kParticipants, rows);
    write_file(
        archive / sidecar_of(kParticipants),
        json_text({{"participant_id", column("the participant's label in the recordings")}}));
}

}  // namespace dibhr
