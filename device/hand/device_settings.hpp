// The settings of a force device, one row per value: name, range, meaning, and a pointer to it. The
// settings file and the Device panel are made from the rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/haptics/enum_names.hpp"
#include "core/haptics/safety.hpp"
#include "device/hand/button_actions.hpp"
#include "device/hand/workspace.hpp"

namespace dibhr {

/// A value of an enumeration of one byte; the value is also the index of its name and label.
struct DeviceEnum {
    std::uint8_t* value;
    std::vector<const char*> names{};   ///< in the settings file
    std::vector<const char*> labels{};  ///< on the panel

    /// `held` must outlive this object. Its table of names must pass has_all_in_order().
    template <HasNameTable Enum>
    explicit DeviceEnum(Enum& held) : value(reinterpret_cast<std::uint8_t*>(&held)) {
        static_assert(sizeof(Enum) == 1);
        for (const NamedValue<Enum>& word : name_table(held)) {
            names.push_back(word.name);
            labels.push_back(word.label);
        }
    }
    [[nodiscard]] std::uint8_t& operator*() const noexcept { return *value; }
};

struct DeviceRow {
    std::string_view name;   ///< in the settings file: "thigh"
    std::string_view topic;  ///< a heading of the panel
    const char* label;       ///< on the panel; of a text: the placeholder of the empty field
    const char* help;        ///< meaning, and where the default comes from
    std::variant<bool*, int*, double*, std::string*, ButtonAction*, DeviceEnum> value;
    double lowest{0.0};      ///< of a number, as stored; every value of the range is safe
    double highest{0.0};     ///< likewise; of a text: the most bytes that can be typed
    const char* format{""};  ///< printf format of a number on the panel, with the unit
    double panel_factor{
        1.0};  ///< panel units per stored unit: 1000 for metres shown as millimetres
    std::optional<Protection> protection{};
};

/// The row of WorkspaceOptions::scale.
[[nodiscard]] inline DeviceRow scale_row(std::string_view topic, double& scale) {
    return {.name = "scale",
            .topic = topic,
            .label = "Scale",
            .help =
                "Millimetres in the image for each millimetre of the hand. A larger image "
                "feels softer: the stiffness in the hand never exceeds 1 N/mm",
            .value = &scale,
            .lowest = 0.1,
            .highest = 10.0,
            .format = "x %.2f"};
}

/// The row of one coordinate of WorkspaceOptions::offset_mm: "offset-x", "Offset right".
[[nodiscard]] inline DeviceRow offset_row(std::string_view name, const char* label,
                                          std::string_view topic, double& offset_mm,
                                          const char* help) {
    return {name, topic, label, help, &offset_mm, -200.0, 200.0, "%.1f mm"};
}

/// The row of the edge of the box in which a hand moves comfortably.
[[nodiscard]] inline DeviceRow box_row(std::string_view topic, double& box_mm) {
    return {"box",
            topic,
            "Comfortable box",
            "Edge of the box that your hand moves in without effort; the image is fitted to it",
            &box_mm,
            kSmallestBox_mm,
            kLargestBox_mm,
            "%.0f mm"};
}

/// A heading of the panel, above the rows of that topic.
struct DeviceTopic {
    const char* name;
    const char* remark{""};    ///< above the rows
    const char* fit_help{""};  ///< help of the button that fits the image; empty: no such button
    bool connection{false};    ///< its rows take effect at the next start of the program
};

/// The settings of one kind of device; a new object holds the defaults.
struct DeviceSettings {
    explicit DeviceSettings(const DeviceButtons& grip = {}, const WorkspaceOptions& usual = {})
        : buttons(standard_actions(grip)), workspace(usual) {}
    DeviceSettings(const DeviceSettings&) = default;
    DeviceSettings& operator=(const DeviceSettings&) = default;
    virtual ~DeviceSettings() = default;

    ButtonActions buttons;
    WorkspaceOptions workspace;

    [[nodiscard]] virtual std::unique_ptr<DeviceSettings> clone() const = 0;
    /// All values, in the order of the settings file.
    [[nodiscard]] virtual std::vector<DeviceRow> rows() = 0;
    /// In the order of the panel.
    [[nodiscard]] virtual std::vector<DeviceTopic> topics() const = 0;
    /// Image millimetres per hand millimetre.
    [[nodiscard]] double scale() const noexcept { return workspace.scale; }
    /// Sets the scale at which the hand reaches the whole image.
    virtual void fit(const ImageFrame& image) noexcept {
        workspace.scale = fitting_scale(image, workspace);
    }
    /// Limits of the device at this scale, whether or not a device is attached.
    [[nodiscard]] virtual DeviceLimits limits() const = 0;

  protected:
    /// Appends the rows of WorkspaceOptions::offset_mm. `aside`, `out`: what they move.
    void add_offset_rows(std::vector<DeviceRow>& rows, std::string_view topic, const char* aside,
                         const char* out) {
        rows.push_back(offset_row("offset-x", "Offset right", topic, workspace.offset_mm.x, aside));
        rows.push_back(offset_row("offset-y", "Offset up", topic, workspace.offset_mm.y, aside));
        rows.push_back(offset_row("offset-z", "Offset out", topic, workspace.offset_mm.z, out));
    }
    /// Appends the rows of the device's buttons.
    void add_buttons(std::vector<DeviceRow>& rows, const DeviceButtons& grip,
                     std::string_view topic) {
        for (std::size_t k = 0; k < buttons.size(); ++k) {
            if (grip[k].setting.empty()) continue;
            rows.push_back({.name = grip[k].setting,
                            .topic = topic,
                            .label = grip[k].label,
                            .help = "What this button of the grip does",
                            .value = &buttons[k],
                            .protection = grip[k].protection});
        }
    }
};

/// What tunes every device, in addition to the settings of its kind.
struct HandTuning {
    double max_force_newton;
    std::uint32_t centre_count;  ///< a new value resets the clutch's shift
};

/// Returns `tuning` with workspace, clutch buttons, force-off buttons and `centre_count` set, and
/// `max_force_newton` where it has one.
template <typename Tuning>
[[nodiscard]] Tuning with_hand_tuning(Tuning tuning, const DeviceSettings& settings,
                                      const HandTuning& hand) noexcept {
    tuning.workspace = settings.workspace;
    tuning.clutch_buttons = buttons_for(ButtonAction::clutch, settings.buttons);
    tuning.force_off_buttons = buttons_for(ButtonAction::force_off, settings.buttons);
    tuning.centre_count = hand.centre_count;
    if constexpr (requires { tuning.max_force_newton; })
        tuning.max_force_newton = hand.max_force_newton;
    return tuning;
}

}  // namespace dibhr
