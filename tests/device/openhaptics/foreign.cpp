// A library without any function of OpenHaptics but one.
extern "C" __attribute__((visibility("default"))) unsigned hdInitDevice(const char* name) {
    return name == nullptr ? 0U : 1U;
}
