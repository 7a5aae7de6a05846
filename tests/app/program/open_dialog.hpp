// The window's own dialog for opening files, used by keyboard.
#pragma once

#include <string>

#include "tests/app/program/desk.hpp"

namespace dibhr::test {

/// In the dialog that is opening: types the name until nothing else is listed, opens that, and
/// waits until keys are the window's again.
inline void open_by_name(const WindowProgram& viewer, const std::string& name) {
    viewer.wait_until([](const Seen& now) { return now.dialog_typing && !now.dialog_reads; });
    viewer.act("type " + name);
    viewer.wait_until([](const Seen& now) { return now.dialog_entries == 1; });
    viewer.act("key Return");
    viewer.wait_until([](const Seen& now) { return !now.dialog_typing; });
    viewer.wait_for_turn();
}

}  // namespace dibhr::test
