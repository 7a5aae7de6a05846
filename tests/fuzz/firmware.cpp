// A firmware file: what is taken is a boot stream, whether it came as bytes or as C source, and a
// reason to refuse is one line.
#include "device/falcon/firmware_image.hpp"
#include "tests/fuzz/entry.hpp"

using namespace dibhr;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const test::InputFile file("firmware.bin");
    const std::string fault = falcon::fault_of_firmware({data, size});
    if (!fault.empty()) test::require_one_line(fault);
    const auto& path = file.with({data, size});
    (void)test::is_taken([&path] {
        const falcon::FirmwareImage image = falcon::read_firmware(path);
        test::require_rule(falcon::fault_of_firmware(image.bytes).empty(),
                           "what is taken is a boot stream");
        test::require_rule(image.sha256.size() == 64 && !image.name.empty(), "an image has a name");
    });
    return 0;
}
