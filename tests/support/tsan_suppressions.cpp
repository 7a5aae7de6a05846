// What the thread sanitizer is to pass over in test programs that use OpenCV, with the reasons.

// libavcodec and libavutil are the distribution's, built without the sanitizer: it sees their
// memory but not the atomics that order it between their decoding threads. libgdal comes with
// OpenCV's picture readers; it takes two of its own locks in either order while it registers its
// drivers.
extern "C" const char* __tsan_default_suppressions();  // NOLINT: the sanitizer's name

extern "C" const char* __tsan_default_suppressions() {  // NOLINT
    return "race:libavcodec.so\n"
           "race:libavutil.so\n"
           "race:libavformat.so\n"
           "race:libswscale.so\n"
           "called_from_lib:libavcodec.so\n"
           "deadlock:libgdal.so\n";
}
