// In the place of a maker's library.
extern "C" int sample_version() {
    return 7;
}
