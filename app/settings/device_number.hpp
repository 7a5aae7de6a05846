// One number that people tune of a device.
#pragma once

#include <string_view>

namespace dibhr {

/// Its default is what Settings{} holds; `topic`: a heading of the panel.
template <typename Settings, typename Topic>
struct DeviceNumber {
    Topic topic;
    std::string_view name;  ///< "thigh", in the settings file
    const char* label;      ///< "Thigh (a)", for the panel
    const char* format;     ///< printf format of the panel, with the unit
    double shown;           ///< panel units in a stored one: 1000 for metres shown as millimetres
    double lowest;          ///< stored unit; every value of the range is safe
    double highest;
    const char* help;  ///< meaning, and where the default comes from
    double& (*in)(Settings&);
};

}  // namespace dibhr
