// Rows of the Device panel that every force device has: what its table of settings says.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "app/panels/widgets.hpp"
#include "app/settings/grip_buttons.hpp"
#include "device/hand/device_settings.hpp"

namespace dibhr {

inline void draw_device_value(const DeviceRow& row, bool* value, const bool* usual) {
    flag_row(row.label, *value, *usual, row.help);
}

inline void draw_device_value(const DeviceRow& row, double* value, const double* usual) {
    double shown = *value * row.shown;
    const NumberRow number{.label = row.label,
                           .format = row.format,
                           .lowest = row.lowest * row.shown,
                           .highest = row.highest * row.shown,
                           .standard = *usual * row.shown,
                           .help = row.help,
                           .logarithmic = row.lowest > 0.0 && row.highest > 50.0 * row.lowest};
    if (number_row(number, shown)) *value = std::clamp(shown / row.shown, row.lowest, row.highest);
}

inline void draw_device_value(const DeviceRow& row, int* value, const int* usual) {
    double number = *value;
    const double standard = *usual;
    draw_device_value(row, &number, &standard);
    *value = static_cast<int>(std::lround(number));
}

inline void draw_device_value(const DeviceRow& row, std::string* value, const std::string*) {
    std::array<char, 128> text{};
    const auto room = std::span(text).first(static_cast<std::size_t>(row.highest) + 1);
    value->copy(room.data(), room.size() - 1);
    const std::string id = "##" + std::string(row.topic) + "-" + std::string(row.name);
    if (text_field(id.c_str(), row.label, room, row.help, false)) *value = room.data();
}

inline void draw_device_value(const DeviceRow& row, ButtonAction* value,
                              const ButtonAction* usual) {
    choice_row(row.label, button_jobs(), *value, row.help, *usual);
}

inline void draw_device_value(const DeviceRow& row, const DeviceWord& value,
                              const DeviceWord& usual) {
    int chosen = *value;
    index_row(row.label, value.labels, chosen, row.help, *usual);
    *value = static_cast<std::uint8_t>(chosen);
}

/// Those of `topic`, texts behind the others.
template <typename OwnSettings>
void draw_device_rows(OwnSettings& settings, std::string_view topic) {
    OwnSettings standard;
    const std::vector<DeviceRow> rows = settings.rows();
    const std::vector<DeviceRow> usual = standard.rows();
    for (const bool texts : {false, true}) {
        for (std::size_t k = 0; k < rows.size(); ++k) {
            if (rows[k].topic != topic) continue;
            std::visit(
                [&]<typename Place>(const Place& value) {
                    if (std::is_same_v<Place, std::string*> == texts)
                        draw_device_value(rows[k], value, std::get<Place>(usual[k].value));
                },
                rows[k].value);
        }
    }
}

}  // namespace dibhr
