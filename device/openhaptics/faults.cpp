// The errors that the library reports.
#include "device/openhaptics/faults.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace dibhr::openhaptics {

namespace {

constexpr int kMostFaults = 64;  // a stack that never gets empty must not hold the servo thread

struct Named {
    unsigned int code;
    FaultClass kind;
    const char* name;
};
constexpr std::array<Named, 20> kNamed{
    {{kHdUnknownParameter, FaultClass::call, "unknown parameter"},
     {0x101, FaultClass::call, "invalid value"},
     {0x102, FaultClass::call, "call at the wrong time"},
     {0x103, FaultClass::call, "wrong type"},
     {0x104, FaultClass::link, "unknown device"},
     {kHdWarmMotors, FaultClass::force, "warm motors"},
     {0x201, FaultClass::force, "force too high"},
     {0x202, FaultClass::force, "force changed too fast"},
     {0x203, FaultClass::force, "hand too fast"},
     {0x204, FaultClass::force, "force error"},
     {0x300, FaultClass::link, "device fault"},
     {kHdInUse, FaultClass::link, "device already open"},
     {0x302, FaultClass::link, "communication error"},
     {0x303, FaultClass::link, "wrong connection settings"},
     {0x304, FaultClass::link, "timer error"},
     {0x400, FaultClass::call, "frame begun twice"},
     {0x401, FaultClass::call, "frame ended twice"},
     {0x402, FaultClass::call, "frame error"},
     {0x500, FaultClass::link, "invalid priority"},
     {0x501, FaultClass::link, "scheduler full"}}};

const Named* named(unsigned int code) noexcept {
    const auto* const found = std::find_if(kNamed.begin(), kNamed.end(),
                                           [code](const Named& one) { return one.code == code; });
    return found == kNamed.end() ? nullptr : found;
}

}  // namespace

FaultClass class_of(unsigned int code) noexcept {
    if (code == kHdSuccess) return FaultClass::none;
    const Named* const known = named(code);
    return known != nullptr ? known->kind : FaultClass::link;
}

Fault take_faults(const HdLibrary& library) noexcept {
    Fault gravest;
    for (int k = 0; k < kMostFaults; ++k) {
        const HdErrorInfo error = library.get_error();
        if (error.code == kHdSuccess) break;
        const FaultClass kind = class_of(error.code);
        if (kind > gravest.kind) gravest = {kind, error.code, error.internal_code};
    }
    return gravest;
}

std::string name_of(const Fault& fault) {
    const Named* const known = named(fault.code);
    std::array<char, 48> number{};
    std::snprintf(number.data(), number.size(), " 0x%x (%d)", fault.code, fault.internal_code);
    const char* const name = fault.code == kHdInvalidLicense ? "invalid licence"
                             : known != nullptr              ? known->name
                                                             : "error";
    return name + std::string(number.data());
}

std::string why_not_opened(const Fault& fault, const std::string& name) {
    const std::string asked = name.empty() ? "no Touch" : "no Touch with the name " + name;
    if (fault.code == kHdInUse)
        return "the Touch is in use by another program (" + name_of(fault) + "): end that one";
    if (fault.code == kHdInvalidLicense)
        return "OpenHaptics has no valid licence (" + name_of(fault) +
               "): install it again, and accept its licence";
    const std::string reason = fault.kind == FaultClass::none ? "" : " (" + name_of(fault) + ")";
    return asked + " answers" + reason +
           ": plug in its cable and its power, and set it up once with 3D Systems' setup program; "
           "where that worked before, delete the files in ~/.3dsystems/config and set it up again";
}

std::string why_lost(const Fault& fault) {
    return "the Touch was lost (" + name_of(fault) +
           "): check its cable and its power, and plug it in again; an Ethernet one is paired "
           "again "
           "with its button";
}

}  // namespace dibhr::openhaptics
