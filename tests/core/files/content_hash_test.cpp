// The content hash against the standard's own examples.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;

TEST_CASE("the content hash is SHA-256 as the standard's examples have it", "[files]") {
    CHECK(sha256_of({}) == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    const std::vector<std::uint8_t> abc{'a', 'b', 'c'};
    CHECK(sha256_of(abc) == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_CASE("a file's hash is that of its bytes, however long it is; a missing file is told",
          "[files]") {
    const test::TemporaryFolder folder;
    const auto file = folder / "any.bin";
    std::vector<std::uint8_t> bytes(5'000'001);
    for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = static_cast<std::uint8_t>(k * 7);
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    CHECK(sha256_of_file(file) == sha256_of(bytes));
    CHECK(sha256_of_file(file, 4'000'003) == sha256_of(std::span(bytes).subspan(4'000'003)));
    Sha256 in_parts;
    in_parts.add(std::span(bytes).first(1001));
    in_parts.add(std::span(bytes).subspan(1001));
    CHECK(in_parts.digits() == sha256_of(bytes));
    std::ofstream(file, std::ios::binary | std::ios::trunc);
    CHECK(sha256_of_file(file) == sha256_of({}));
    std::filesystem::remove(file);
    CHECK_THROWS_AS(sha256_of_file(file), InputError);
}

TEST_CASE("a folder's hash is that of its names and bytes, wherever the folder is", "[files]") {
    const test::TemporaryFolder folder;
    const auto fill = [&](const std::string& name, const std::string& text) {
        std::filesystem::create_directories(folder / name / "depth");
        std::ofstream(folder / name / "1.png") << text;
        std::ofstream(folder / name / "depth" / "1.png") << "two";
    };
    fill("here", "one");
    fill("there", "one");
    const std::string sum = sha256_of_file(folder / "here");
    CHECK(sum == sha256_of_file(folder / "there"));
    CHECK(content_bytes(folder / "here") == 6);
    std::ofstream(folder / "there" / ".listing") << "of a file manager";
    CHECK(sum == sha256_of_file(folder / "there"));
    std::filesystem::rename(folder / "there" / "1.png", folder / "there" / "2.png");
    CHECK(sum != sha256_of_file(folder / "there"));
    fill("there", "One");
    CHECK(sum != sha256_of_file(folder / "there"));
}
