// `dibhr devices`: what is attached, and why it cannot be used.
#pragma once

namespace dibhr {

/// Lists on standard output. 0: something can be used (the mouse always can).
int run_devices();

}  // namespace dibhr
