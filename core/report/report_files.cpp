// A report's files in their folder: all of them, or none.
#include "core/report/report_files.hpp"

#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/video/input_file.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

void remove_empty(const std::vector<fs::path>& folders) {
    std::error_code not_empty;
    for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) {
        fs::remove(*folder, not_empty);
    }
}

}  // namespace

ReportFiles::ReportFiles(const fs::path& folder, std::vector<std::string> names)
    : folder_(folder), names_(std::move(names)) {
    make_folder();
    try {
        for (const std::string& name : names_) {
            std::error_code ignored;
            const fs::file_status status = fs::status(folder_ / name, ignored);
            if (fs::exists(status) && !fs::is_regular_file(status)) {
                throw InputError(shown(folder_ / name) +
                                 " is in the way: it is no file that a report could replace; "
                                 "move it or choose another folder");
            }
        }
        const OutputFile probe(folder_ / names_.front());  // leaves nothing: never committed
    } catch (...) {
        remove_empty(made_);
        throw;
    }
}

ReportFiles::~ReportFiles() {
    files_.clear();
    remove_empty(made_);  // which a report that was written does not let happen
}

void ReportFiles::make_folder() {
    std::vector<fs::path> missing;
    std::error_code failed;
    fs::path part = fs::absolute(folder_, failed).lexically_normal();
    if (!part.has_filename()) part = part.parent_path();  // "report/"
    for (; !part.empty() && !fs::exists(part, failed) && !failed; part = part.parent_path()) {
        missing.insert(missing.begin(), part);
    }
    for (const fs::path& folder : missing) {
        if (fs::create_directory(folder, failed)) made_.push_back(folder);
        if (failed) break;
    }
    if (!failed && fs::is_directory(folder_, failed)) return;
    remove_empty(made_);
    const std::string why = failed ? failed.message() : "it is no folder";
    throw InputError(shown(folder_) + " cannot take a report (" + why +
                     "): choose a folder you may write to");
}

void ReportFiles::add(const std::string& name, std::string_view bytes) {
    auto file = std::make_unique<OutputFile>(folder_ / name);
    file->write(bytes);
    files_.push_back(std::move(file));
    added_.insert(name);
}

void ReportFiles::commit() {
    for (const auto& file : files_) file->commit();
    files_.clear();
    made_.clear();
    for (const std::string& name : names_) {
        std::error_code ignored;  // a picture of an earlier report that could not be removed
        if (!added_.contains(name)) fs::remove(folder_ / name, ignored);
    }
}

}  // namespace dibhr
