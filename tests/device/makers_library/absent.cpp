// A library that is needed, and that no loader finds.
extern "C" int absent_version() {
    return 1;
}
