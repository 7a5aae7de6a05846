// Names in an archive, and its manifest.
#include "core/archive/archive_layout.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <sstream>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kDigits = 64;  // of a sum

bool is_letter_or_digit(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x80 && std::isalnum(byte) != 0;
}

}  // namespace

std::string ParticipantNames::name_of(const std::string& label) {
    const auto known = names_.find(label);
    if (known != names_.end()) return known->second;
    std::string plain;
    std::ranges::copy_if(label, std::back_inserter(plain), is_letter_or_digit);
    const std::string first = "sub-" + (plain.empty() ? "unlabelled" : plain);
    std::string name = first;
    // Labels that differ in a sign alone are different people's; a file system may ignore case.
    const auto is_taken = [&](const std::string& wanted) {
        return std::ranges::any_of(
            names_, [&](const auto& one) { return lower_case(one.second) == lower_case(wanted); });
    };
    for (int number = 2; is_taken(name); ++number) name = first + "x" + std::to_string(number);
    return names_[label] = name;
}

std::string run_name(const std::string& participant, std::string_view task, std::size_t run) {
    std::ostringstream name;
    name << participant << "_task-" << task << "_run-" << std::setw(3) << std::setfill('0') << run;
    return name.str();
}

std::filesystem::path table_of(const std::string& participant, const std::string& run,
                               std::string_view what) {
    return std::filesystem::path(participant) / "beh" / (run + "_" + std::string(what) + ".csv");
}

std::string plain_name(std::string name) {
    for (char& c : name)
        if (static_cast<unsigned char>(c) < ' ' || c == '\\' || c == '\x7f') c = '_';
    return name;
}

std::string manifest_text(const Manifest& manifest) {
    std::string text;
    for (const auto& [name, sum] : manifest) text += sum + "  " + name + "\n";
    return text;
}

Manifest read_manifest(const std::filesystem::path& archive) {
    std::ifstream file(archive / kManifest);
    if (!file)
        throw InputError(archive.string() + ": holds no " + kManifest +
                         "; name a folder that dibhr archive made");
    Manifest manifest;
    for (std::string line; std::getline(file, line);)
        if (line.size() > kDigits + 2) manifest[line.substr(kDigits + 2)] = line.substr(0, kDigits);
    return manifest;
}

}  // namespace dibhr
