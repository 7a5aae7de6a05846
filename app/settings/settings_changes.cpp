// Settings compared and taken over value by value, in the order of their list.
#include "app/settings/settings_changes.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/settings/settings_list.hpp"

namespace dibhr {

namespace {

using Value = std::variant<double, std::string>;

/// Every value in the list's order, so that two states can be compared one by one.
class Listing {
  public:
    void flag(std::string_view, std::string_view, bool& value) {
        values.emplace_back(value ? 1.0 : 0.0);
    }
    void number(std::string_view, std::string_view, double& value, Range) {
        values.emplace_back(value);
    }
    void integer(std::string_view, std::string_view, int& value, Range) {
        values.emplace_back(static_cast<double>(value));
    }
    template <typename Enum>
    void word(std::string_view, std::string_view, Enum& value, const Words<Enum>&) {
        values.emplace_back(static_cast<double>(value));
    }
    void text(std::string_view, std::string_view, std::string& value) {
        values.emplace_back(value);
    }

    std::vector<Value> values{};
};

std::vector<Value> values_of(const Settings& settings) {
    Listing listing;
    Settings copy = settings;
    visit_settings(copy, listing);
    return listing.values;
}

/// Puts values back in the list's order.
class Filling {
  public:
    explicit Filling(const std::vector<Value>& values) : values_(values) {}
    void flag(std::string_view, std::string_view, bool& value) { value = next_number() > 0.5; }
    void number(std::string_view, std::string_view, double& value, Range) { value = next_number(); }
    void integer(std::string_view, std::string_view, int& value, Range) {
        value = static_cast<int>(std::lround(next_number()));
    }
    template <typename Enum>
    void word(std::string_view, std::string_view, Enum& value, const Words<Enum>&) {
        value = static_cast<Enum>(std::lround(next_number()));
    }
    void text(std::string_view, std::string_view, std::string& value) {
        value = std::get<std::string>(values_[next_++]);
    }

  private:
    double next_number() { return std::get<double>(values_[next_++]); }

    const std::vector<Value>& values_;
    std::size_t next_{0};
};

}  // namespace

Settings changes_kept(const Settings& in_file, const Settings& started, const Settings& now) {
    std::vector<Value> kept = values_of(in_file);
    const std::vector<Value> before = values_of(started);
    const std::vector<Value> after = values_of(now);
    for (std::size_t k = 0; k < kept.size(); ++k) {
        if (before[k] != after[k]) kept[k] = after[k];
    }
    Settings result = in_file;
    Filling filling(kept);
    visit_settings(result, filling);
    return result;
}

bool same_settings(const Settings& a, const Settings& b) {
    return values_of(a) == values_of(b);
}

}  // namespace dibhr
