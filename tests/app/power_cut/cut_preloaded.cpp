// The disk of a whole program.
#include "tests/app/power_cut/cut_disk.hpp"

namespace {

__attribute__((constructor)) void begin() {
    dibhr::test::begin_cut();
}
__attribute__((destructor)) void end() {
    dibhr::test::tell_steps();
}

}  // namespace
