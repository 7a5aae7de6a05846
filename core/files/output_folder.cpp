// A command's files in their folder: all of them, or none.
#include "core/files/output_folder.hpp"

#include <system_error>
#include <utility>

#include "core/error.hpp"

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

OutputFolder::OutputFolder(const fs::path& folder, std::vector<std::string> names)
    : folder_(folder), names_(std::move(names)) {
    make_folder();
    try {
        for (const std::string& name : names_) {
            std::error_code ignored;
            const fs::file_status status = fs::status(folder_ / name, ignored);
            if (fs::exists(status) && !fs::is_regular_file(status)) {
                throw InputError((folder_ / name).string() +
                                 " is in the way: it is no file that could be replaced; move it or "
                                 "choose another folder");
            }
        }
        const OutputFile probe(folder_ / "probe");  // leaves nothing: never committed
    } catch (...) {
        remove_empty(made_);
        throw;
    }
}

OutputFolder::~OutputFolder() {
    files_.clear();
    remove_empty(made_);  // which files that were committed do not let happen
}

void OutputFolder::make_folder() {
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
    throw InputError(folder_.string() + " cannot take files (" + why +
                     "): choose a folder you may write to");
}

void OutputFolder::add(const std::string& name, std::string_view bytes) {
    if (!added_.insert(name).second) return;
    auto file = std::make_unique<OutputFile>(folder_ / name);
    file->write(bytes);
    files_.push_back(std::move(file));
}

void OutputFolder::commit() {
    for (const auto& file : files_) file->commit();
    files_.clear();
    made_.clear();
    for (const std::string& name : names_) {
        std::error_code ignored;  // a file of an earlier run that could not be removed
        if (!added_.contains(name)) fs::remove(folder_ / name, ignored);
    }
}

}  // namespace dibhr
