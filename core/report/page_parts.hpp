// The parts of reports' pages: style, sections, tables and pictures.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/files/output_file.hpp"
#include "core/plot/canvas.hpp"

namespace dibhr {

/// A picture of a report.
struct Figure {
    std::string name{};   ///< "heat-map": of its files, without their endings
    std::string files{};  ///< "heat-map.svg, heat-map.pdf"
    std::string title{};
    std::string caption{};
    int columns{0}, rows{0};
    std::string png{};
};

/// "heat-map.svg"
[[nodiscard]] std::string picture_file(const std::string& name, PlotFormat format);

/// The names of all files of a report: these pictures in every format, and `others`.
[[nodiscard]] std::vector<std::string> report_files(std::vector<std::string> others,
                                                    const std::vector<std::string>& pictures);

/// Adds figures to a report.
struct FigureMaker {
    OutputFolder& files;
    std::span<const PlotFormat> formats;
    std::vector<Figure>& figures;

    /// Adds the plot's files to the folder. Throws InputError when one cannot be written.
    void add(const std::string& name, const std::string& title, const std::string& caption,
             const Canvas& plot) const;
};

/// A page up to its header. `title` and `program` (which made it) are plain text.
[[nodiscard]] std::string page_head(const std::string& title, const std::string& program);
/// The end of a page, after its main part; `beside` ends its sentence on files beside it.
[[nodiscard]] std::string page_foot(const std::string& program, const std::string& beside);

/// A word or a method, and what it means.
struct Definition {
    std::string name{};
    std::string meaning{};
};

[[nodiscard]] std::string definitions_html(const std::vector<Definition>& definitions);

/// A list of sentences in plain text.
[[nodiscard]] std::string list_html(const std::vector<std::string>& sentences);

/// With its caption and the names of its files.
[[nodiscard]] std::string figure_html(const Figure& figure);

/// Cells of a row as HTML.
using Cells = std::vector<std::string>;

[[nodiscard]] std::string table_of(const Cells& heads, const std::vector<Cells>& rows);

/// `heading` and `body` are HTML.
[[nodiscard]] std::string section(const std::string& heading, const std::string& body);

}  // namespace dibhr
