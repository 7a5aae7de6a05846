// What falcon_host writes of every command packet (--packets).
#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace dibhr::test::falcon {

struct LoggedPacket {
    double t_s{0.0};  ///< CLOCK_MONOTONIC
    std::array<int, 3> motors{};
    int led{0};  ///< 0 in a farewell only: what a driver in touch sends has one of its lamps on
    bool homing{false};

    [[nodiscard]] bool has_force() const { return motors != std::array<int, 3>{}; }
};

/// The whole rows so far.
[[nodiscard]] inline std::vector<LoggedPacket> read_packets(const std::filesystem::path& file) {
    std::vector<LoggedPacket> packets;
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);  // the names
    while (std::getline(stream, line) && !stream.eof()) {
        LoggedPacket packet;
        int homing = 0;
        std::sscanf(line.c_str(), "%lf,%d,%d,%d,%d,%d", &packet.t_s, &packet.motors[0],
                    &packet.motors[1], &packet.motors[2], &packet.led, &homing);
        packet.homing = homing != 0;
        packets.push_back(packet);
    }
    return packets;
}

/// What came after this moment.
[[nodiscard]] inline std::vector<LoggedPacket> packets_after(const std::filesystem::path& file,
                                                             double t_s) {
    std::vector<LoggedPacket> packets = read_packets(file);
    std::erase_if(packets, [t_s](const LoggedPacket& packet) { return packet.t_s <= t_s; });
    return packets;
}

}  // namespace dibhr::test::falcon
