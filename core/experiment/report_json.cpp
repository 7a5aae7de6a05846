// JSON, written by hand: a handful of objects of numbers and names.
#include "core/experiment/report_json.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/experiment/paper_table.hpp"
#include "core/experiment/sweep.hpp"

namespace dibhr {

namespace {

/// The shortest text that reads back to the same number; JSON has no infinities.
std::string number(double value) {
    if (!std::isfinite(value)) return "null";
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

std::string quoted(std::string_view text) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20) {
            result += "\\u00";
            result += kDigits[byte >> 4U];
            result += kDigits[byte & 15U];
            continue;
        }
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + '"';
}

/// One object: `add` its members, then take the text.
class Object {
  public:
    Object& add(std::string_view name, const std::string& json) {
        text_ += (text_.empty() ? "" : ", ") + quoted(name) + ": " + json;
        return *this;
    }
    Object& add(std::string_view name, double value) { return add(name, number(value)); }
    Object& add(std::string_view name, std::uint64_t value) {
        return add(name, std::to_string(value));
    }
    Object& add(std::string_view name, int value) { return add(name, std::to_string(value)); }
    Object& add_text(std::string_view name, std::string_view value) {
        return add(name, quoted(value));
    }
    [[nodiscard]] std::string text() const { return "{" + text_ + "}"; }

  private:
    std::string text_{};
};

template <typename Items, typename ToJson>
std::string list_of(const Items& items, const std::string& indent, ToJson to_json) {
    std::string text = "[";
    const char* separator = "\n";
    for (const auto& item : items) {
        text += separator + indent + to_json(item);
        separator = ",\n";
    }
    return text + "]";
}

std::string variation_json(const VariationStatistics& v) {
    return Object()
        .add("mean", v.mean_deg)
        .add("sd", v.sd_deg)
        .add("mean_without_reversals", v.mean_without_reversals_deg)
        .add("sd_without_reversals", v.sd_without_reversals_deg)
        .add("pairs", v.pairs)
        .add("pairs_without_reversals", v.pairs_without_reversals)
        .text();
}

std::string error_json(const ExactError& error) {
    return Object()
        .add("max_px", error.max_px)
        .add("mean_px", error.mean_px)
        .add("max_rad", error.max_rad)
        .add("mean_rad", error.mean_rad)
        .text();
}

std::string paper_json(const PathRun& path, const AlgorithmRun& run) {
    const auto paper = paper_result(path.name, run.algorithm);
    if (!paper) return "null";
    return Object()
        .add("update_us", paper->update_us)
        .add("mean_deg", paper->variation_mean_deg)
        .add("sd_deg", paper->variation_sd_deg)
        .text();
}

std::string run_json(const PathRun& path, const AlgorithmRun& run) {
    const SampleStatistics& time = run.time_us;
    const std::string time_json = Object()
                                      .add("mean", time.mean)
                                      .add("median", time.median)
                                      .add("p99", time.p99)
                                      .add("p999", time.p999)
                                      .add("max", time.highest)
                                      .add("whole_run", run.whole_run_us)
                                      .text();
    const auto contact = std::count(run.contact.begin(), run.contact.end(), char{1});
    return Object()
        .add_text("algorithm", name_of(run.algorithm))
        .add("time_us", time_json)
        .add("moves_per_update", run.moves_per_update)
        .add("contact_updates", static_cast<std::uint64_t>(contact))
        .add("bounds_met", run.bounds_met)
        .add("variation_deg", variation_json(run.variation))
        .add("error", run.error ? error_json(*run.error) : "null")
        .add("paper", paper_json(path, run))
        .text();
}

std::string path_json(const PathRun& path) {
    const auto reversals = std::count(path.reversal.begin(), path.reversal.end(), char{1});
    const std::string runs =
        list_of(path.runs, "      ", [&](const AlgorithmRun& run) { return run_json(path, run); });
    return Object()
        .add_text("path", path.name)
        .add_text("source", path.source)
        .add("mu", path.mu)
        .add("depth_px", path.depth_px)
        .add("columns", path.columns)
        .add("rows", path.rows)
        .add("updates", static_cast<std::uint64_t>(path.goals.size()))
        .add("settling_updates", path.settling_updates)
        .add("reversal_updates", static_cast<std::uint64_t>(reversals))
        .add("exact_variation_deg",
             path.exact_proxies.empty() ? "null" : variation_json(path.exact_variation))
        .add("runs", runs)
        .text();
}

Object cell_object(const SweepPoint& point) {
    Object cell;
    cell.add_text("path", point.path)
        .add("mu", point.mu)
        .add("depth_px", point.depth_px)
        .add_text("algorithm", name_of(point.algorithm));
    return cell;
}

std::string point_json(const SweepPoint& point) {
    return cell_object(point)
        .add("median_us", point.median_us)
        .add("moves_per_update", point.moves_per_update)
        .add("bounds_met", point.bounds_met)
        .add("variation_deg", variation_json(point.variation))
        .add("error", error_json(point.error))
        .text();
}

}  // namespace

std::string json_of(std::span<const PathRun> paths, double clock_us) {
    return Object().add("clock_us", clock_us).add("paths", list_of(paths, "  ", path_json)).text() +
           "\n";
}

std::string sweep_json_of(std::span<const SweepPoint> points, int updates, double clock_us) {
    const auto cell_json = [](const SweepPoint& point) { return cell_object(point).text(); };
    return Object()
               .add("clock_us", clock_us)
               .add("updates", updates)
               .add("points", list_of(points, "  ", point_json))
               .add("not_rougher_than_dibhr",
                    list_of(not_rougher_than_dibhr(points), "  ", cell_json))
               .text() +
           "\n";
}

}  // namespace dibhr
