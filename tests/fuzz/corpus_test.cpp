// A fuzz entry as an ordinary test: every input of its corpus, and some hundred that small changes
// make of them (in the long run some thousand), the same on every machine.
#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/entry.hpp"
#include "tests/support/catch.hpp"

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kLongest = 4096;

Bytes content_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<fs::path> corpus() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(DIBHR_CORPUS)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// What went wrong; empty: nothing.
std::string fault_of(const Bytes& input) {
    try {
        LLVMFuzzerTestOneInput(input.data(), input.size());
    } catch (const std::exception& fault) {
        return fault.what();
    }
    return {};
}

/// A test fails, and the input stays for `tests/fuzz/run`.
void fail_with(const Bytes& input, const std::string& fault) {
    const fs::path kept = fs::path(DIBHR_FINDINGS);
    std::ofstream(kept, std::ios::binary)
        .write(reinterpret_cast<const char*>(input.data()),
               static_cast<std::streamsize>(input.size()));
    FAIL(fault << "; the input is " << kept.string());
}

class Changes {
  public:
    explicit Changes(std::vector<Bytes> inputs) : inputs_(std::move(inputs)) {}

    Bytes next() {
        Bytes bytes = inputs_[below(inputs_.size())];
        for (std::size_t change = 1 + below(4); change > 0; --change) apply_one(bytes);
        bytes.resize(std::min(bytes.size(), kLongest));
        return bytes;
    }

  private:
    void apply_one(Bytes& bytes) {
        const std::size_t at = below(bytes.size() + 1);
        const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
        const std::size_t length = std::min(below(32), bytes.size() - at);
        const auto end = place + static_cast<std::ptrdiff_t>(length);
        switch (below(6)) {
            case 0:  // another bit
                if (place != bytes.end()) *place ^= static_cast<std::uint8_t>(1U << below(8));
                break;
            case 1:  // another byte
                if (place != bytes.end()) *place = static_cast<std::uint8_t>(random_());
                break;
            case 2:
                bytes.erase(place, end);
                break;
            case 3: {  // a piece once more
                const Bytes piece(place, end);
                bytes.insert(place, piece.begin(), piece.end());
                break;
            }
            case 4: {  // goes on as another input does
                const Bytes& other = inputs_[below(inputs_.size())];
                const auto from = std::min(at, other.size());
                bytes.erase(place, bytes.end());
                bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(from),
                             other.end());
                break;
            }
            default:
                bytes.insert(place, 1 + below(8), static_cast<std::uint8_t>(random_()));
        }
    }

    /// 0 .. count - 1; not std::uniform_int_distribution, which is another one elsewhere.
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_()) % count; }

    std::vector<Bytes> inputs_;
    std::mt19937_64 random_{1};
};

}  // namespace

TEST_CASE("every input of the corpus is read or refused by the rules", "[fuzz]") {
    const std::vector<fs::path> files = corpus();
    REQUIRE(files.size() >= 3);
    for (const fs::path& file : files) {
        CAPTURE(file.filename().string());
        CHECK(fault_of(content_of(file)) == "");
    }
}

namespace {

void require_changes_kept(int count) {
    std::vector<Bytes> inputs;
    for (const fs::path& file : corpus()) inputs.push_back(content_of(file));
    Changes changes(std::move(inputs));
    for (int k = 0; k < count; ++k) {
        const Bytes input = changes.next();
        const std::string fault = fault_of(input);
        if (!fault.empty()) fail_with(input, fault);
    }
    SUCCEED();
}

}  // namespace

TEST_CASE("so is what small changes make of the corpus", "[fuzz]") {
    require_changes_kept(DIBHR_CHANGES / 4);
}

TEST_CASE("so is what many small changes make of the corpus", "[fuzz][long]") {
    require_changes_kept(DIBHR_CHANGES);
}
