// The parts as HTML5, light and dark, on a screen and on paper.
#include "core/report/page_parts.hpp"

#include <string_view>
#include <utility>

#include "core/files/plain_text.hpp"
#include "core/video/sources/picture_files.hpp"

namespace dibhr {

namespace {

// Pictures keep their white paper in the dark: their inks are made for it.
constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --ground: #fff; --ink: #222; --quiet: #666; --line: #ddd; --stripe: #f6f6f4; }
@media (prefers-color-scheme: dark) {
  :root { --ground: #16181b; --ink: #e6e6e4; --quiet: #a2a6ab; --line: #3a3e44; --stripe: #1e2125; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2rem 1.25rem 4rem; max-width: 76rem; background: var(--ground); color: var(--ink);
  font: 1rem/1.5 system-ui, "Segoe UI", "Liberation Sans", Arial, sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .25rem; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 2.5rem 0 .6rem; }
.quiet, figcaption { color: var(--quiet); }
.summary { font-size: 1.15rem; max-width: 60rem; }
.text { white-space: pre-wrap; overflow-wrap: anywhere; }
.note { border-left: 4px solid var(--line); padding-left: 1rem; }
figure { margin: 1.5rem 0 0; }
figure img { display: block; width: 100%; height: auto; background: #fff; border: 1px solid var(--line); border-radius: 6px; }
figure.map img { width: auto; max-width: 100%; max-height: 92vh; }
figcaption { margin-top: .4rem; max-width: 60rem; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); gap: 0 1.5rem; }
.wide { overflow-x: auto; margin-top: .8rem; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: .3rem .45rem; border-bottom: 1px solid var(--line); }
th { color: var(--quiet); font-weight: 600; }
tbody tr:nth-child(even) { background: var(--stripe); }
code { font-size: .85em; overflow-wrap: anywhere; }
dt { font-weight: 600; margin-top: .6rem; }
dd { margin: 0; max-width: 60rem; }
@media print {
  :root { color-scheme: light; --ground: #fff; --ink: #000; --quiet: #444; --line: #bbb; --stripe: #fff; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  figure, tr { break-inside: avoid; }
  h2 { break-after: avoid; }
  .wide { overflow: visible; }
  table { font-size: 7.5pt; }
  th, td { padding: .15rem .3rem; }
  figure.map img { max-height: 20cm; }
}
)";

std::string row_of(const Cells& cells, const std::string& begin, const std::string& end) {
    std::string row = "<tr>";
    for (const std::string& text : cells) row.append(begin).append(text).append(end);
    return row + "</tr>\n";
}

}  // namespace

std::string picture_file(const std::string& name, PlotFormat format) {
    return name + "." + std::string(name_of(format));
}

std::vector<std::string> report_files(std::vector<std::string> others,
                                      const std::vector<std::string>& pictures) {
    for (const std::string& picture : pictures)
        for (const PlotFormat format : kPlotFormats)
            others.push_back(picture_file(picture, format));
    return others;
}

void FigureMaker::add(const std::string& name, const std::string& title, const std::string& caption,
                      const Canvas& plot) const {
    const ColourImage picture = plot.finished();
    auto png = png_of(picture);
    std::string names;
    for (const PlotFormat format : formats) {
        const std::string file = picture_file(name, format);
        files.add(file, format == PlotFormat::png ? png : plot.encoded(format));
        names += (names.empty() ? "" : ", ") + file;
    }
    figures.push_back({name, names, title, caption, picture.columns, picture.rows, std::move(png)});
}

std::string page_head(const std::string& title, const std::string& program) {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
           "<meta name=\"generator\" content=\"" +
           html_text(program) + "\">\n<title>" + html_text(title) + "</title>\n<style>" +
           std::string(kStyle) + "</style>\n</head>\n<body>\n<header>\n";
}

std::string page_foot(const std::string& program, const std::string& beside) {
    return "</main>\n<footer class=\"quiet\">\n<p>Made by " + html_text(program) +
           ". The numbers are in report.json beside this page, " + beside +
           ".</p>\n</footer>\n</body>\n</html>\n";
}

std::string definitions_html(const std::vector<Definition>& definitions) {
    std::string list = "<dl>\n";
    for (const auto& [name, meaning] : definitions)
        list += "<dt>" + html_text(name) + "</dt><dd>" + html_text(meaning) + "</dd>\n";
    return list + "</dl>\n";
}

std::string list_html(const std::vector<std::string>& sentences) {
    std::string list = "<ul>\n";
    for (const std::string& sentence : sentences)
        list += "<li class=\"text\">" + html_text(sentence) + "</li>\n";
    return list + "</ul>\n";
}

std::string figure_html(const Figure& figure) {
    const bool is_map = figure.name.starts_with("heat-map");
    return std::string("<figure") + (is_map ? " class=\"map\"" : "") + ">\n<img alt=\"" +
           html_text(figure.title) + "\" width=\"" + std::to_string(figure.columns) +
           "\" height=\"" + std::to_string(figure.rows) + "\" src=\"data:image/png;base64," +
           base64_text(figure.png) + "\">\n<figcaption>" + html_text(figure.caption) +
           " <span class=\"quiet\">(" + html_text(figure.files) + ")</span></figcaption>\n" +
           "</figure>\n";
}

std::string table_of(const Cells& heads, const std::vector<Cells>& rows) {
    std::string table = "<div class=\"wide\"><table>\n<thead>" +
                        row_of(heads, "<th scope=\"col\">", "</th>") + "</thead>\n<tbody>\n";
    for (const Cells& row : rows) table += row_of(row, "<td>", "</td>");
    return table + "</tbody></table></div>\n";
}

std::string section(const std::string& heading, const std::string& body) {
    return "<section>\n<h2>" + heading + "</h2>\n" + body + "</section>\n";
}

}  // namespace dibhr
