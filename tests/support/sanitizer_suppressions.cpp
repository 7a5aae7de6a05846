// What the sanitizers must ignore in the program and its tests, and why: libraries of the
// distribution are built without the thread sanitizer, which sees their memory but not all their
// synchronization.

// libavcodec and its family order their decoding threads with atomics; unless libavutil's pool of
// pictures is ignored from the start, each 8 bytes of a picture give a report, and a picture takes
// seconds. libavfilter and libswscale unlock what libavutil has locked for them. libgdal comes with
// OpenCV's picture readers and writers; it takes two of its own locks in either order while it
// registers its drivers. libudev's devices are written by libusb's event thread, under a lock,
// before the thread that lists them reads them. A testbed of libumockdev has a thread of its own,
// joined with GLib's atomics. Mesa's software driver counts who still needs a fence with atomics,
// and destroys it when nobody does; it is swrast_dri.so, or in newer ones libgallium. Pango matches
// fonts on a thread of its own and keeps Fontconfig's results until the program ends. libsrt
// destroys what its queues still read when a connection is closed. The dynamic linker guards its
// lists of libraries by a lock of its own while two threads load some.
extern "C" const char* __tsan_default_suppressions();  // NOLINT: the sanitizer's name
extern "C" const char* __lsan_default_suppressions();  // NOLINT: the sanitizer's name

extern "C" const char* __tsan_default_suppressions() {  // NOLINT
    return "race:libavcodec.so\n"
           "race:libavutil.so\n"
           "race:libavformat.so\n"
           "race:libswscale.so\n"
           "called_from_lib:libavcodec.so\n"
           "called_from_lib:libavutil.so\n"
           "mutex:libavfilter.so\n"
           "mutex:libswscale.so\n"
           "deadlock:libgdal.so\n"
           "race:libudev.so.1\n"
           "race:libumockdev.so.0\n"
           "race:libglib-2.0.so.0\n"
           "race:swrast_dri.so\n"
           "race:libgallium\n"
           "race:libpangoft2-1.0.so.0\n"
           "race:libfontconfig.so.1\n"
           "race:libsrt\n"
           "race:ld-linux\n";
}

extern "C" const char* __lsan_default_suppressions() {  // NOLINT
    return "leak:libfontconfig.so.1\n"
           "leak:cairo_recording_surface_create\n";
}
