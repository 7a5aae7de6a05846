// Reads and writes sidecars: files beside a media file that state what its depth means.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// Where the sidecar of a file or folder is written: NAME.toml beside it.
[[nodiscard]] std::filesystem::path sidecar_of(const std::filesystem::path& media);

/// The `[depth]` table of the sidecar of `media`, NAME.toml or NAME.EXTENSION.toml; nothing where
/// there is none. Throws InputError for one that cannot be parsed: which file, which line.
[[nodiscard]] std::optional<DepthStatement> read_sidecar(const std::filesystem::path& media);

/// The `[depth]` table of a file, likewise; nothing where there is none.
[[nodiscard]] std::optional<DepthStatement> read_statement(const std::filesystem::path& file);

/// Writes the `[depth]` table of the sidecar of `media`, whole or not at all; keeps its other
/// tables. Throws InputError.
void write_sidecar(const std::filesystem::path& media, const DepthStatement& statement);

/// The statement as TOML, one fact a line, and back; numbers are as short as reads back the same.
/// Throws InputError that begins with `name` for a text that cannot be parsed.
[[nodiscard]] std::string toml_of(const DepthStatement& statement);
[[nodiscard]] DepthStatement statement_in(const std::string& toml, const std::string& name);

// The same facts in the syntax of the command line. Each returns nothing for an invalid text.

/// "0,65535": finite numbers between commas; empty: none.
[[nodiscard]] std::optional<std::vector<double>> levels_in(const std::string& text);
/// "0.001": a number above 0.
[[nodiscard]] std::optional<double> scale_in(const std::string& text);
/// "480:4210": two finite numbers that differ.
[[nodiscard]] std::optional<DepthRange> range_in(const std::string& text);
/// "FX,FY,CX,CY": the focal lengths 0.001 or more; or a horizontal field of view of 1 to less than
/// 179 degrees: "60deg", "60 deg", "60°", "60".
[[nodiscard]] std::optional<Intrinsics> intrinsics_in(const std::string& text);
/// "60deg", or the four numbers; reads back to the same bits.
[[nodiscard]] std::string text_of(const Intrinsics& said);
/// "RIGHT,DOWN,SCALE": depth pixels, and 0.01 to 100.
[[nodiscard]] std::optional<Registration> registration_in(const std::string& text);
/// "-0.05": seconds, at most a day.
[[nodiscard]] std::optional<double> offset_in(const std::string& text);
/// "29.97": 0.001 to 10000 frames a second; 0: as the source has it.
[[nodiscard]] std::optional<double> rate_in(const std::string& text);

}  // namespace dibhr
