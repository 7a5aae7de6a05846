// libav's hardware contexts.
#include "core/av/decoding_device.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/buffer.h>
#include <libavutil/frame.h>
#include <libavutil/hwcontext.h>
}

#include <algorithm>
#include <system_error>
#include <vector>

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// Of pictures in the memory of such a device; AV_PIX_FMT_NONE: the decoder does not know it.
AVPixelFormat format_in(AVHWDeviceType type, int codec) {
    const AVCodec* const decoder = avcodec_find_decoder(static_cast<AVCodecID>(codec));
    for (int k = 0; decoder != nullptr; ++k) {
        const AVCodecHWConfig* const config = avcodec_get_hw_config(decoder, k);
        if (config == nullptr) break;
        const bool by_context = (config->methods & AV_CODEC_HW_CONFIG_METHOD_HW_DEVICE_CTX) != 0;
        if (config->device_type == type && by_context) return config->pix_fmt;
    }
    return AV_PIX_FMT_NONE;
}

class AvDevice : public DecodingDevice {
  public:
    /// Takes over the reference.
    AvDevice(const char* name, AVBufferRef* opened, AVPixelFormat format)
        : name_(name), opened_(opened), format_(format) {}
    ~AvDevice() override { av_buffer_unref(&opened_); }

    [[nodiscard]] std::string name() const override { return name_; }

    void take(AVCodecContext& context) override {
        context.hw_device_ctx = av_buffer_ref(opened_);
        context.opaque = this;
        context.get_format = own_format;
    }

    [[nodiscard]] AvOwned<AVFrame> fetched(const AVFrame& picture) override {
        AvOwned<AVFrame> copy = new_frame();
        if (picture.format != format_ || av_hwframe_transfer_data(copy.get(), &picture, 0) < 0 ||
            av_frame_copy_props(copy.get(), &picture) < 0)
            return nullptr;
        return copy;
    }

  private:
    /// No other format: then decoding fails, and starts again in software with its threads.
    static AVPixelFormat own_format(AVCodecContext* context, const AVPixelFormat* offered) {
        const AVPixelFormat own = static_cast<const AvDevice*>(context->opaque)->format_;
        for (; *offered != AV_PIX_FMT_NONE; ++offered)
            if (*offered == own) return own;
        return AV_PIX_FMT_NONE;
    }

    std::string name_;
    AVBufferRef* opened_;
    AVPixelFormat format_;  ///< of pictures in its memory
};

std::shared_ptr<DecodingDevice> opened(const char* name, AVHWDeviceType type, int codec,
                                       const char* file) {
    const AVPixelFormat format = format_in(type, codec);
    AVBufferRef* device = nullptr;
    if (format == AV_PIX_FMT_NONE || av_hwdevice_ctx_create(&device, type, file, nullptr, 0) < 0)
        return nullptr;
    return std::make_shared<AvDevice>(name, device, format);
}

}  // namespace

std::shared_ptr<DecodingDevice> open_decoding_device(int codec, const fs::path& devices) {
    std::error_code none;
    if (fs::exists(devices / "nvidia0", none))
        if (auto device = opened("CUDA", AV_HWDEVICE_TYPE_CUDA, codec, nullptr)) return device;
    std::vector<std::string> nodes;
    for (const fs::directory_entry& node : fs::directory_iterator(devices / "dri", none))
        if (node.path().filename().string().starts_with("renderD"))
            nodes.push_back(node.path().string());
    std::ranges::sort(nodes);
    for (const std::string& node : nodes)
        if (auto device = opened("VAAPI", AV_HWDEVICE_TYPE_VAAPI, codec, node.c_str()))
            return device;
    return nullptr;
}

}  // namespace dibhr
