// What the fuzz entries share: the file that a parser reads, and what every refusal must be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>

#include "core/error.hpp"
#include "tests/support/temporary_folder.hpp"

/// One input. Throws test::RuleBroken when the program broke a rule over it; whatever else leaves
/// it is a finding too.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace dibhr::test {

/// No family of the program's own errors, so that nothing but the fuzzer takes it.
class RuleBroken : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

inline void require_rule(bool kept, const std::string& rule) {
    if (!kept) throw RuleBroken(rule);
}

inline void require_one_line(const std::string& text) {
    require_rule(!text.empty() && text.find('\n') == std::string::npos,
                 "what a person is told is one line, and is not: " + text);
}

/// Whether it was taken; else it was refused as it should be: by an InputError of one line.
template <typename Read>
bool is_taken(Read&& read) {
    try {
        read();
    } catch (const InputError& refusal) {
        require_one_line(refusal.what());
        return false;
    }
    return true;
}

/// The input as the file that a parser opens.
class InputFile {
  public:
    explicit InputFile(const std::string& name) : path_(folder_ / name) {}

    const std::filesystem::path& with(std::span<const std::uint8_t> bytes) const {
        std::ofstream(path_, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        return path_;
    }
    [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }

  private:
    TemporaryFolder folder_{};
    std::filesystem::path path_;
};

}  // namespace dibhr::test
