// The module of libav's devices: cameras, and libav's own made pictures.
extern "C" {
#include <libavdevice/avdevice.h>

void dibhr_register_devices();
void dibhr_register_devices() {
    avdevice_register_all();
}
}
