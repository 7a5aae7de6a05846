// WebSocket and HTTP by Boost.Beast over a socket with deadlines. Only this file includes Beast,
// which takes long to compile.
#include "device/inverse3/service_link.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/beast/core/flat_static_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/stream.hpp>

#include <array>
#include <exception>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "device/inverse3/deadline_socket.hpp"

namespace dibhr::inverse3 {

namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;
using Why = LinkError::Why;

error_code as_boost(const std::error_code& error) noexcept {
    return error ? error_code(error.value(), boost::system::system_category()) : error_code();
}

/// The layer below Beast's stream; only its synchronous part is ever used.
class SocketLayer {
  public:
    using executor_type = boost::asio::io_context::executor_type;

    explicit SocketLayer(boost::asio::io_context& context) : context_(&context) {}

    [[nodiscard]] executor_type get_executor() noexcept { return context_->get_executor(); }
    [[nodiscard]] DeadlineSocket& socket() noexcept { return *socket_; }
    /// Limits one read to the bytes that Beast still needs, whatever the size of its buffer, so
    /// that nothing is read ahead.
    void set_longest_read(std::size_t bytes) noexcept { longest_read_ = bytes; }
    /// Redirects all writes from the socket into `frame`; null: back to the socket.
    void write_into(std::vector<std::uint8_t>* frame) noexcept { frame_ = frame; }

    template <typename Buffers>
    std::size_t read_some(const Buffers& buffers, error_code& error) {
        const boost::asio::mutable_buffer first =
            boost::asio::buffer(first_of(buffers), longest_read_);
        if (first.size() == 0) {
            error = {};
            return 0;
        }
        std::error_code failure;
        const std::size_t got =
            socket_->read({static_cast<std::uint8_t*>(first.data()), first.size()}, failure);
        error = as_boost(failure);
        if (got == 0 && !error) error = boost::asio::error::eof;
        return got;
    }
    template <typename Buffers>
    std::size_t read_some(const Buffers& buffers) {
        error_code error;
        const std::size_t got = read_some(buffers, error);
        if (error) throw boost::system::system_error(error);
        return got;
    }
    template <typename Buffers>
    std::size_t write_some(const Buffers& buffers, error_code& error) {
        std::array<iovec, 8> parts{};  // further parts are written by the next call
        std::size_t count = 0;
        auto it = boost::asio::buffer_sequence_begin(buffers);
        const auto end = boost::asio::buffer_sequence_end(buffers);
        for (; it != end && count < parts.size(); ++it) {
            const boost::asio::const_buffer buffer(*it);
            parts[count++] = {const_cast<void*>(buffer.data()), buffer.size()};
        }
        const auto written = std::span(parts).first(count);
        error = {};
        if (frame_ != nullptr) return add_to_frame(written);
        std::error_code failure;
        const std::size_t gone = socket_->write(written, failure);
        error = as_boost(failure);
        return gone;
    }
    template <typename Buffers>
    std::size_t write_some(const Buffers& buffers) {
        error_code error;
        const std::size_t gone = write_some(buffers, error);
        if (error) throw boost::system::system_error(error);
        return gone;
    }

  private:
    /// The first buffer that is not empty.
    template <typename Buffers>
    static boost::asio::mutable_buffer first_of(const Buffers& buffers) {
        auto it = boost::asio::buffer_sequence_begin(buffers);
        const auto end = boost::asio::buffer_sequence_end(buffers);
        for (; it != end; ++it) {
            const boost::asio::mutable_buffer buffer(*it);
            if (buffer.size() > 0) return buffer;
        }
        return {};
    }

    std::size_t add_to_frame(std::span<const iovec> parts) {
        const std::size_t before = frame_->size();
        for (const iovec& part : parts) {
            const auto* const begin = static_cast<const std::uint8_t*>(part.iov_base);
            frame_->insert(frame_->end(), begin, begin + part.iov_len);
        }
        return frame_->size() - before;
    }

    boost::asio::io_context* context_;
    std::unique_ptr<DeadlineSocket> socket_{std::make_unique<DeadlineSocket>()};
    std::size_t longest_read_{std::numeric_limits<std::size_t>::max()};
    std::vector<std::uint8_t>* frame_{nullptr};
};

/// During its lifetime, writes to the layer are kept in `frame` and not sent.
class KeptWrites {
  public:
    KeptWrites(SocketLayer& layer, std::vector<std::uint8_t>& frame) noexcept : layer_(layer) {
        layer_.write_into(&frame);
    }
    ~KeptWrites() { layer_.write_into(nullptr); }
    KeptWrites(const KeptWrites&) = delete;
    KeptWrites& operator=(const KeptWrites&) = delete;

  private:
    SocketLayer& layer_;
};

/// Beast finds these two by name, and calls them when a WebSocket ends.
void teardown(beast::role_type /*role*/, SocketLayer& layer, error_code& error) {
    layer.socket().close();
    error = {};
}
template <typename Handler>
void async_teardown(beast::role_type /*role*/, SocketLayer& layer, Handler&& handler) {
    layer.socket().close();
    std::forward<Handler>(handler)(error_code());
}

LinkError failure_to_connect(std::uint16_t port, const std::string& why, Why kind) {
    return {kind, "port " + std::to_string(port) + " of this machine: " + why};
}

/// Throws LinkError.
void connect(SocketLayer& layer, std::uint16_t port, DeadlineSocket::Time deadline) {
    layer.socket().set_deadline(deadline);
    if (const std::error_code refusal = layer.socket().connect(port)) {
        throw failure_to_connect(port, refusal.message(), Why::refused);
    }
}

}  // namespace

struct ServiceLink::Stream {
    boost::asio::io_context context{1};  // never runs, but Beast needs one
    websocket::stream<SocketLayer> socket{context};
    beast::flat_static_buffer<kLongestMessage_bytes> message{};
};

ServiceLink::ServiceLink(std::uint16_t port, Time deadline) : stream_(std::make_unique<Stream>()) {
    connect(stream_->socket.next_layer(), port, deadline);
    // Byte by byte: the inventory may directly follow the HTTP head of the handshake's answer.
    stream_->socket.next_layer().set_longest_read(1);
    stream_->socket.read_message_max(kLongestMessage_bytes);
    error_code refusal;
    stream_->socket.handshake("localhost:" + std::to_string(port), "/", refusal);
    if (refusal) throw failure_to_connect(port, refusal.message(), Why::not_the_service);
    stream_->socket.text(true);
}

ServiceLink::~ServiceLink() = default;

void ServiceLink::send(std::string_view text, Time deadline) {
    stream_->socket.next_layer().socket().set_deadline(deadline);
    error_code failure;
    stream_->socket.write(boost::asio::buffer(text.data(), text.size()), failure);
    if (failure) throw LinkError(Why::lost, failure.message());
}

std::string_view ServiceLink::read(Time deadline) {
    stream_->socket.next_layer().socket().set_deadline(deadline);
    stream_->message.clear();
    error_code failure;
    do {
        // A frame's head is read byte by byte, as only Beast knows its length; then the rest.
        stream_->socket.next_layer().set_longest_read(stream_->socket.read_size_hint(1));
        stream_->socket.read_some(stream_->message, 0, failure);
    } while (!failure && !stream_->socket.is_message_done());
    if (failure) {
        const bool long_one = failure == websocket::error::message_too_big ||
                              failure == websocket::error::buffer_overflow;
        throw LinkError(long_one ? Why::too_long : Why::lost, failure.message());
    }
    const auto whole = stream_->message.data();
    return {static_cast<const char*>(whole.data()), whole.size()};
}

bool ServiceLink::wait(const Wake* wake, Time until) const noexcept {
    return stream_->socket.next_layer().socket().wait_readable(wake, until);
}

int ServiceLink::descriptor() const noexcept {
    return stream_->socket.next_layer().socket().descriptor();
}

StopPacket ServiceLink::set_stop_packet(std::string_view text) {
    std::vector<std::uint8_t> frame;
    if (!text.empty()) {
        const KeptWrites kept(stream_->socket.next_layer(), frame);
        error_code failure;
        stream_->socket.write(boost::asio::buffer(text.data(), text.size()), failure);
        if (failure) throw LinkError(Why::lost, failure.message());
    }
    stream_->socket.next_layer().socket().set_stop_packet(frame);
    StopPacket last;
    last.set_message(frame);
    return last;
}

bool ServiceLink::close(Time deadline) noexcept {
    stream_->socket.next_layer().socket().set_deadline(deadline);
    try {
        error_code failure;
        stream_->socket.close(websocket::close_code::normal, failure);
        return !failure;
    } catch (const std::exception&) {
        // No memory for the close frame: the socket is closed all the same.
        stream_->socket.next_layer().socket().close();
        return false;
    }
}

std::string http_get(std::uint16_t port, std::string_view target, ServiceLink::Time deadline) {
    namespace http = beast::http;
    boost::asio::io_context context{1};
    SocketLayer layer(context);
    connect(layer, port, deadline);
    http::request<http::empty_body> question(http::verb::get,
                                             beast::string_view(target.data(), target.size()), 11);
    question.set(http::field::host, "localhost:" + std::to_string(port));
    question.set(http::field::connection, "close");
    http::response_parser<http::string_body> answer;
    answer.body_limit(ServiceLink::kLongestMessage_bytes);
    beast::flat_static_buffer<8192> buffer;
    error_code failure;
    http::write(layer, question, failure);
    if (!failure) http::read(layer, buffer, answer, failure);
    if (failure) throw failure_to_connect(port, failure.message(), Why::not_the_service);
    if (answer.get().result() != http::status::ok) {
        throw failure_to_connect(port, "status " + std::to_string(answer.get().result_int()),
                                 Why::not_the_service);
    }
    return std::move(answer.get().body());
}

}  // namespace dibhr::inverse3
