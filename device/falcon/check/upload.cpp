// Step 2: whether firmware is present, and a logged upload (../README.md, Upload).
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "device/falcon/bring_up.hpp"
#include "device/falcon/check/context.hpp"

namespace dibhr::falcon {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint8_t kUsualLastByte = 'A';  // byte 14 of a reply

double ms_since(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// The bytes received within 50 ms after one packet without force.
std::vector<std::uint8_t> raw_reply(FtdiPort& port) {
    constexpr std::chrono::milliseconds kLimit{50};
    port.write(encode(Command{}));
    std::vector<std::uint8_t> bytes;
    const auto end = Clock::now() + kLimit;
    while (bytes.size() < kPacketBytes && Clock::now() < end) {
        const auto came = port.read(std::chrono::milliseconds(5)).bytes;
        bytes.insert(bytes.end(), came.begin(), came.end());
    }
    return bytes;
}

void probe(CheckContext& context, const char* name, Json& measured) {
    const auto begin = Clock::now();
    const bool answers = context.falcon.answers();
    Json part{{"answers", answers}, {"took_ms", ms_since(begin)}};
    if (answers) {
        const auto bytes = raw_reply(context.falcon.port());
        part["reply"] = hexadecimal(bytes);
        if (bytes.size() == kPacketBytes) {
            const std::array<std::uint8_t, 1> last{bytes[kPacketBytes - 2]};
            context.findings.record_answer(
                OpenQuestion::last_byte,
                last[0] == kUsualLastByte ? "41, as expected" : hexadecimal(last) + ", not 41");
        }
    }
    measured[name] = part;
}

/// Number of bytes before the known answer.
std::size_t stray_bytes(const UploadStep& step) {
    const std::size_t answer = std::string(step.name) == "hello" ? 4 : 1;
    return step.received.size() - std::min(step.received.size(), answer);
}

/// Result of one upload.
struct Upload {
    bool done{false};
    int tries{0};
    std::string stray{};  ///< bytes before an answer, as text
};

Json as_json(const UploadStep& step, double at_ms) {
    Json line{{"at_ms", at_ms},
              {"try", step.number},
              {"step", step.name},
              {"done", step.done},
              {"baud_value", step.baud.value},
              {"baud_index", step.baud.index}};
    if (!step.received.empty()) line["heard"] = hexadecimal(step.received);
    return line;
}

/// Uploads, each with its log in the record, also when it fails.
class LoggedUploads {
  public:
    LoggedUploads(CheckContext& context, Json& measured) : context_(context), measured_(measured) {}

    /// Repeats the upload until it succeeds or the user skips it.
    Upload run(bool slower) {
        Upload upload = once(slower, false);
        try {
            while (!upload.done) {
                context_.word(
                    "Unplug the power adapter, wait ten seconds, plug it in again. Enter = try "
                    "again, s = leave this speed out, q = quit");
                upload = once(slower, true);
            }
        } catch (const StepSkipped&) {
            // This speed alone.
            return upload;
        }
        return upload;
    }

  private:
    Upload once(bool slower, bool after_power_cycle) {
        Upload result;
        Json steps = Json::array();
        std::stop_source stop;
        const auto begin = Clock::now();
        UploadOptions options;
        options.slower = slower;
        options.on_progress = [&](double in, int number) {
            result.tries = number;
            context_.console.show("try " + std::to_string(number) + ": " +
                                  std::to_string(static_cast<int>(in * 100.0)) + " %");
            if (context_.console.interrupted()) stop.request_stop();
        };
        options.on_step = [&](const UploadStep& step) {
            steps.push_back(as_json(step, ms_since(begin)));
            note_stray_bytes(step, result.stray);
        };
        Json& part = measured_["upload_" + std::to_string(++number_)];
        part = {{"baud", slower ? 140351 : 142857}, {"after_power_cycle", after_power_cycle}};
        context_.falcon.set_answering(false);
        try {
            result.done = upload(context_.falcon.port(), context_.options.firmware.bytes, options,
                                 stop.get_token());
        } catch (const UploadError& failure) {
            part["failure"] = failure.what();
            context_.console.print(failure.what());
        }
        context_.falcon.set_answering(result.done);
        part["done"] = result.done;
        part["took_ms"] = ms_since(begin);
        part["tries"] = result.tries;
        part["steps"] = steps;
        if (stop.stop_requested()) throw PersonQuits{};
        return result;
    }

    static void note_stray_bytes(const UploadStep& step, std::string& words) {
        const std::size_t stray = step.done && !step.received.empty() ? stray_bytes(step) : 0;
        if (stray == 0) return;
        words += (words.empty() ? "" : ", ") + hexadecimal(step.received.first(stray)) +
                 " before the " + step.name + "'s answer";
    }

    CheckContext& context_;
    Json& measured_;
    int number_{0};
};

std::string in_words(const Upload& upload) {
    if (!upload.done) return "failed";
    return upload.tries == 1 ? "at the first try" : "at try " + std::to_string(upload.tries);
}

void load_at_both_speeds(CheckContext& context, Json& measured) {
    const bool ran_before = context.falcon.answering();
    LoggedUploads uploads(context, measured);
    const Upload fast = uploads.run(false);
    const Upload slow = uploads.run(true);
    const std::string speeds = "142 857: " + in_words(fast) + "; 140 351: " + in_words(slow);
    context.findings.record_answer(OpenQuestion::upload_speed, speeds);
    context.console.print(speeds);
    if (!fast.done && slow.done) context.findings.set("slower-upload", "true");
    if (fast.done || slow.done) {
        const bool both = !fast.stray.empty() && !slow.stray.empty();
        const std::string stray = fast.stray + (both ? "; " : "") + slow.stray;
        context.findings.record_answer(OpenQuestion::stray_bytes, stray.empty() ? "none" : stray);
    }
    if ((fast.done && slow.done) || (ran_before && fast.done)) {
        context.findings.record_answer(OpenQuestion::loading_again,
                                       "DTR puts a running Falcon back into its boot loader");
    }
    if (!context.falcon.answering() && !context.falcon.answers()) {
        throw DeviceError("no firmware gets into " + full_name_of(context.falcon.attached()) +
                          ": unplug its power adapter and its USB cable for ten seconds, then run "
                          "the check again");
    }
}

}  // namespace

void check_upload(CheckContext& context, Json& measured) {
    probe(context, "probe", measured);
    const FirmwareImage& image = context.options.firmware;
    if (image.empty()) {
        measured["firmware"] = nullptr;
        if (!context.falcon.answering()) {
            throw DeviceError(missing_firmware_advice(context.falcon.attached()) +
                              "; then: dibhr devices --check --firmware FILE");
        }
        context.console.print("It answers. No firmware file is at hand, so none is loaded.");
        return;
    }
    measured["firmware"] = image.name;
    measured["firmware_sha256"] = image.sha256;
    context.begin(std::string(context.falcon.answering() ? "It answers" : "It does not answer") +
                  ". Enter = load " + image.name + " twice, s = load nothing, q = quit");
    load_at_both_speeds(context, measured);
    probe(context, "probe_after", measured);
}

}  // namespace dibhr::falcon
