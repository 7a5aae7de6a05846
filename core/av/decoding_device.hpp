// A device of this machine that decodes videos: a graphics card, through libav's hardware contexts.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/av/objects.hpp"

namespace dibhr {

/// Decodes one track. Its pictures are in its own memory until they are fetched.
class DecodingDevice {
  public:
    DecodingDevice() = default;
    virtual ~DecodingDevice() = default;
    DecodingDevice(const DecodingDevice&) = delete;
    DecodingDevice& operator=(const DecodingDevice&) = delete;

    /// For people: "VAAPI".
    [[nodiscard]] virtual std::string name() const = 0;
    /// Makes a context, which is not open yet and which the device outlives, decode in it. What the
    /// device does not offer (a profile, a size, a form of pixels) makes the decoding fail.
    virtual void take(AVCodecContext& context) = 0;
    /// A decoded picture with its times, in the program's memory; null: the device failed.
    [[nodiscard]] virtual AvOwned<AVFrame> fetched(const AVFrame& picture) = 0;
};

/// The first device that offers this AVCodecID and can be opened: CUDA where the folder `devices`
/// has an nvidia0, then VAAPI for each dri/renderD* in it; null: none. Without such a file nothing
/// is loaded or opened.
[[nodiscard]] std::shared_ptr<DecodingDevice> open_decoding_device(
    int codec, const std::filesystem::path& devices = "/dev");

}  // namespace dibhr
