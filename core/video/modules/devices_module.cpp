// The module of libav's devices: cameras, and pictures that libav generates (lavfi).
extern "C" {
#include <libavdevice/avdevice.h>

void dibhr_register_devices();
void dibhr_register_devices() {
    avdevice_register_all();
}
}
