// The run-time packets and the stream they come in (device/falcon/README.md, Run-time packets).
#include "device/falcon/packet.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "tests/support/catch.hpp"

namespace {

using namespace dibhr::falcon;
using Bytes = std::vector<std::uint8_t>;

/// The letters of a number, by the rule as the README words it.
Bytes letters_of(std::int16_t number) {
    const auto bits = static_cast<std::uint16_t>(number);
    Bytes letters;
    for (const unsigned shift : {0U, 4U, 8U, 12U}) {
        letters.push_back(static_cast<std::uint8_t>('A' + ((bits >> shift) & 0xFU)));
    }
    return letters;
}

Packet packet_of(const Counts& numbers, std::uint8_t flags, std::uint8_t unknown = 'A') {
    Bytes bytes{'<'};
    for (const std::int16_t number : numbers) {
        const Bytes letters = letters_of(number);
        bytes.insert(bytes.end(), letters.begin(), letters.end());
    }
    bytes.insert(bytes.end(), {static_cast<std::uint8_t>('A' + flags), unknown, '>'});
    Packet packet{};
    std::copy(bytes.begin(), bytes.end(), packet.begin());
    return packet;
}

/// A reply that contains its own number.
Packet numbered(int number) {
    const auto first = static_cast<std::int16_t>(number);
    return packet_of({first, static_cast<std::int16_t>(-first), 4660},
                     static_cast<std::uint8_t>(number % 128));
}

void append(Bytes& stream, const Packet& packet) {
    stream.insert(stream.end(), packet.begin(), packet.end());
}

class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    std::size_t below(std::size_t end) {
        return std::uniform_int_distribution<std::size_t>(0, end - 1)(engine_);
    }
    std::uint8_t byte() { return static_cast<std::uint8_t>(below(256)); }
    /// A byte that often looks like part of a reply.
    std::uint8_t tempting_byte() {
        constexpr std::array<std::uint8_t, 6> kTempting{'<', '<', '>', 'A', 'P', 0xC0};
        return below(4) == 0 ? byte() : kTempting[below(kTempting.size())];
    }

  private:
    std::mt19937 engine_;
};

/// First encoder of each reply in `bytes`, added in one piece.
void read_all(ReplyStream& stream, std::span<const std::uint8_t> bytes, std::vector<int>& found) {
    while (!bytes.empty()) {
        if (const auto reply = stream.add(bytes)) found.push_back(reply->encoder[0]);
    }
}

/// The same with the bytes cut into random pieces.
std::vector<int> read_in_pieces(ReplyStream& stream, const Bytes& bytes, Random& random) {
    std::vector<int> found;
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t piece = std::min(1 + random.below(40), bytes.size() - at);
        read_all(stream, std::span(bytes).subspan(at, piece), found);
        at += piece;
    }
    return found;
}

struct CommandExample {
    Command command;
    Packet packet;
};

struct ReplyExample {
    Packet packet;
    Reply reply;
};

// clang-format off
const std::vector<CommandExample> kCommands{
    {{},
     {0x3C, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x3E}},
    {{{0, 0, 0}, Led::red, true},
     {0x3C, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x4A, 0x41, 0x3E}},
    {{{661, 731, 766}, Led::blue, false},
     {0x3C, 0x46, 0x4A, 0x43, 0x41, 0x4C, 0x4E, 0x43, 0x41, 0x4F, 0x50, 0x43, 0x41, 0x45, 0x41, 0x3E}},
    {{{-679, 2529, -1862}, Led::blue, true},
     {0x3C, 0x4A, 0x46, 0x4E, 0x50, 0x42, 0x4F, 0x4A, 0x41, 0x4B, 0x4C, 0x49, 0x50, 0x46, 0x41, 0x3E}},
    {{{4095, -4095, 1}, Led::green, false},
     {0x3C, 0x50, 0x50, 0x50, 0x41, 0x42, 0x41, 0x41, 0x50, 0x42, 0x41, 0x41, 0x41, 0x43, 0x41, 0x3E}}};

const std::vector<ReplyExample> kReplies{
    {{0x3C, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x41, 0x3E},
     {{0, 0, 0}, 0, 0}},
    {{0x3C, 0x4A, 0x46, 0x4B, 0x50, 0x41, 0x41, 0x41, 0x41, 0x48, 0x4B, 0x46, 0x41, 0xB1, 0x41, 0x3E},
     {{-1447, 0, 1447}, 0, 7}},
    {{0x3C, 0x41, 0x45, 0x47, 0x41, 0x41, 0x4D, 0x4A, 0x50, 0x4A, 0x42, 0x41, 0x41, 0xB6, 0x41, 0x3E},
     {{1600, -1600, 25}, 1 + 4, 7}},
    {{0x3C, 0x50, 0x50, 0x50, 0x50, 0x4F, 0x50, 0x50, 0x50, 0x4E, 0x50, 0x50, 0x50, 0x53, 0x41, 0x3E},
     {{-1, -2, -3}, 2, 1}},
    {{0x3C, 0x4D, 0x43, 0x42, 0x41, 0x47, 0x50, 0x50, 0x50, 0x42, 0x4F, 0x4F, 0x50, 0xC0, 0x41, 0x3E},
     {{300, -10, -287}, 15, 7}}};
// clang-format on

}  // namespace

TEST_CASE("the worked commands of the README encode to its bytes", "[packet]") {
    const CommandExample example = GENERATE(from_range(kCommands));
    CHECK(encode(example.command) == example.packet);
}

TEST_CASE("the worked replies of the README decode to its numbers", "[packet]") {
    const ReplyExample example = GENERATE(from_range(kReplies));
    const std::optional<Reply> reply = decode(example.packet);
    REQUIRE(reply);
    CHECK(reply->encoder == example.reply.encoder);
    CHECK(reply->buttons == example.reply.buttons);
    CHECK(reply->homed == example.reply.homed);
}

TEST_CASE("every 16-bit number comes back from the letters it is sent as, on every axis",
          "[packet]") {
    int wrong = 0;
    for (int number = INT16_MIN; number <= INT16_MAX; ++number) {
        const auto value = static_cast<std::int16_t>(number);
        const auto other = static_cast<std::int16_t>(~number);
        const Counts counts{value, other, value};
        const Packet packet = encode({counts, Led::off, false});
        const auto reply = decode(packet);
        if (packet != packet_of(counts, 0) || !reply || reply->encoder != counts) ++wrong;
    }
    CHECK(wrong == 0);
}

TEST_CASE("homing and the logo's colour are bits of their own", "[packet]") {
    const Led led = GENERATE(Led::off, Led::green, Led::blue, Led::red);
    const auto bits = static_cast<int>(led);
    CHECK(encode({{}, led, false})[13] == 'A' + bits);
    CHECK(encode({{}, led, true})[13] == 'A' + bits + 1);
}

TEST_CASE("all 128 states of buttons and homed axes are told apart", "[packet]") {
    for (int flags = 0; flags < 128; ++flags) {
        CAPTURE(flags);
        const auto reply = decode(packet_of({}, static_cast<std::uint8_t>(flags)));
        REQUIRE(reply);
        CHECK(reply->buttons == (flags & 15));
        CHECK(reply->homed == flags >> 4);
    }
}

TEST_CASE("a byte that cannot stand where it stands makes it no reply", "[packet]") {
    const Packet good = numbered(1234);
    for (std::size_t place = 0; place < kPacketBytes; ++place) {
        for (int value = 0; value < 256; ++value) {
            Packet packet = good;
            packet[place] = static_cast<std::uint8_t>(value);
            const bool may_stand = place == 0    ? value == 0x3C
                                   : place <= 12 ? value >= 0x41 && value <= 0x50
                                   : place == 13 ? value >= 0x41 && value <= 0xC0
                                   : place == 14 ? true
                                                 : value == 0x3E;
            if (decode(packet).has_value() != may_stand) {
                CAPTURE(place, value);
                FAIL_CHECK("taken for the opposite");
            }
        }
    }
    CHECK(decode(good));
}

TEST_CASE("replies are found however the stream is cut and joined", "[reply stream]") {
    const unsigned seed = GENERATE(range(1U, 21U));
    CAPTURE(seed);
    Random random(seed);
    Bytes bytes;
    std::vector<int> sent;
    for (int number = 1; number <= 500; ++number) {
        append(bytes, numbered(number));
        sent.push_back(number);
    }
    ReplyStream stream;
    CHECK(read_in_pieces(stream, bytes, random) == sent);
    CHECK(stream.discarded() == 0);
}

TEST_CASE("no garbage between replies loses one of them", "[reply stream]") {
    const unsigned seed = GENERATE(range(1U, 41U));
    CAPTURE(seed);
    Random random(seed);
    Bytes bytes;
    std::vector<int> sent;
    std::size_t garbage = 0;
    for (int number = 1; number <= 500; ++number) {
        const std::size_t length = random.below(3) == 0 ? random.below(40) : 0;
        for (std::size_t k = 0; k < length; ++k) bytes.push_back(random.tempting_byte());
        garbage += length;
        append(bytes, numbered(number));
        sent.push_back(number);
    }
    ReplyStream stream;
    CHECK(read_in_pieces(stream, bytes, random) == sent);
    CHECK(stream.discarded() == garbage);
}

TEST_CASE("a byte lost, doubled or overwritten costs the reply it was in and no other",
          "[reply stream]") {
    enum class Damage { lost, doubled, overwritten };
    const Damage damage = GENERATE(Damage::lost, Damage::doubled, Damage::overwritten);
    for (std::size_t place = 0; place < kPacketBytes; ++place) {
        for (const int over : {0x00, 0x3C, 0x3E, 0x41, 0xFF}) {
            CAPTURE(place, over);
            Bytes bytes;
            for (int number = 1; number <= 5; ++number) append(bytes, numbered(number));
            const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(2 * kPacketBytes + place);
            if (damage == Damage::lost) bytes.erase(at);
            if (damage == Damage::doubled) bytes.insert(at, *at);
            if (damage == Damage::overwritten) *at = static_cast<std::uint8_t>(over);
            ReplyStream stream;
            std::vector<int> found;
            read_all(stream, bytes, found);
            // What the damage left of the third may by chance read as a reply of its own.
            if (found.size() == 5) found.erase(found.begin() + 2);
            CHECK(found == std::vector<int>{1, 2, 4, 5});
        }
    }
}

TEST_CASE("a reply broken off anywhere does not hide the one that follows", "[reply stream]") {
    for (std::size_t length = 0; length < kPacketBytes; ++length) {
        CAPTURE(length);
        const Packet broken = numbered(7);
        Bytes bytes(broken.begin(), broken.begin() + static_cast<std::ptrdiff_t>(length));
        append(bytes, numbered(8));
        ReplyStream stream;
        std::vector<int> found;
        read_all(stream, bytes, found);
        CHECK(found == std::vector<int>{8});
        CHECK(stream.discarded() == length);
    }
}

TEST_CASE("two packets laid over each other leave those around them whole", "[reply stream]") {
    for (std::size_t over = 1; over < kPacketBytes; ++over) {
        CAPTURE(over);
        Bytes bytes;
        append(bytes, numbered(1));
        append(bytes, numbered(2));
        bytes.resize(bytes.size() - over);  // the end of 2 is overwritten by 3
        append(bytes, numbered(3));
        append(bytes, numbered(4));
        ReplyStream stream;
        std::vector<int> found;
        read_all(stream, bytes, found);
        CHECK(found == std::vector<int>{1, 3, 4});
    }
}

TEST_CASE("what follows a reply stays to be added next", "[reply stream]") {
    Bytes bytes;
    append(bytes, numbered(1));
    append(bytes, numbered(2));
    bytes.push_back('<');
    std::span<const std::uint8_t> rest(bytes);
    ReplyStream stream;
    REQUIRE(stream.add(rest));
    CHECK(rest.size() == kPacketBytes + 1);
    REQUIRE(stream.add(rest));
    CHECK(rest.size() == 1);
    CHECK_FALSE(stream.add(rest));
    CHECK(rest.empty());
}

TEST_CASE("a half reply that is forgotten joins nothing", "[reply stream]") {
    const Packet packet = numbered(5);
    ReplyStream stream;
    std::vector<int> found;
    read_all(stream, std::span(packet).first(10), found);
    stream.clear();
    read_all(stream, std::span(packet).subspan(10), found);
    CHECK(found.empty());
    read_all(stream, packet, found);
    CHECK(found == std::vector<int>{5});
}

TEST_CASE("noise alone is no reply, and all but its last bytes are counted", "[reply stream]") {
    Random random(3);
    Bytes bytes(100000);
    std::generate(bytes.begin(), bytes.end(), [&] { return random.byte(); });
    ReplyStream stream;
    CHECK(read_in_pieces(stream, bytes, random).empty());
    CHECK(stream.discarded() <= bytes.size());
    CHECK(stream.discarded() > bytes.size() - kPacketBytes);
}
