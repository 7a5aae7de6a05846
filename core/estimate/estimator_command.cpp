// Splits a command into words, and fills its places.
#include "core/estimate/estimator_command.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr std::string_view kSpaces = " \t\r\n";
/// Operators of a shell.
constexpr std::array<std::string_view, 9> kOfAShell{"|", "||", "&", "&&", ";",
                                                    ">", ">>", "<", "2>"};

[[noreturn]] void refuse(const std::string& command, const std::string& why) {
    throw InputError("the estimator's command " + in_quotes(command, 120) + " " + why);
}

std::string home() {
    const char* const folder = std::getenv("HOME");
    return folder != nullptr ? folder : "~";
}

/// Splits a text into words.
class Splitter {
  public:
    explicit Splitter(const std::string& text) : text_(text) {}

    /// The next word; nothing at the end.
    std::optional<std::string> next() {
        at_ = std::min(text_.find_first_not_of(kSpaces, at_), text_.size());
        if (at_ == text_.size()) return std::nullopt;
        const std::size_t begin = at_;
        word_.clear();
        if (text_[at_] == '~' && (at_ + 1 == text_.size() || text_[at_ + 1] == '/')) {
            word_ = home();
            ++at_;
        }
        while (at_ < text_.size() && kSpaces.find(text_[at_]) == std::string_view::npos) take();
        const std::string as_written = text_.substr(begin, at_ - begin);
        if (std::find(kOfAShell.begin(), kOfAShell.end(), as_written) != kOfAShell.end())
            refuse(text_, "has " + as_written +
                              ", but is started without a shell: write what needs one into a "
                              "script, and name that");
        return word_;
    }

  private:
    void take() {
        const char c = text_[at_++];
        if (c == '\'' || c == '"')
            take_quoted(c);
        else if (c == '\\' && at_ < text_.size())
            word_ += text_[at_++];
        else
            word_ += c;
    }

    void take_quoted(char quote) {
        for (; at_ < text_.size(); ++at_) {
            char c = text_[at_];
            if (c == quote) {
                ++at_;
                return;
            }
            const bool escapes = quote == '"' && c == '\\' && at_ + 1 < text_.size() &&
                                 (text_[at_ + 1] == '"' || text_[at_ + 1] == '\\');
            if (escapes) c = text_[++at_];
            word_ += c;
        }
        refuse(text_, std::string("has a ") + quote + " that is not closed: close it");
    }

    const std::string& text_;
    std::size_t at_{0};
    std::string word_{};
};

/// A place in a word, from { to }, and its name between them.
struct Place {
    std::size_t begin{0}, length{0};
    std::string name{};
};

/// The first place from there on. Names have small letters, digits and points; other braces stay.
std::optional<Place> next_place(const std::string& word, std::size_t from) {
    for (std::size_t begin = word.find('{', from); begin != std::string::npos;
         begin = word.find('{', begin + 1)) {
        const std::size_t end =
            word.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789._", begin + 1);
        if (end == std::string::npos || word[end] != '}' || end == begin + 1) continue;
        return Place{begin, end + 1 - begin, word.substr(begin + 1, end - begin - 1)};
    }
    return std::nullopt;
}

bool is_output(const std::string& name) {
    return name == "output" || (name.starts_with("output.") && name.size() > 7);
}

std::string path_at(const std::string& name, const EstimatorPlaces& places) {
    if (name == "input") return places.input.string();
    if (name == "frames") return places.frames.string();
    if (name == "output") return places.output.string();
    return (places.output / ("depth" + name.substr(6))).string();
}

}  // namespace

EstimatorCommand::EstimatorCommand(std::string text) : text_(std::move(text)) {
    Splitter splitter(text_);
    while (auto word = splitter.next()) words_.push_back(std::move(*word));
    if (words_.empty()) throw InputError("the estimator's command is empty: say what is started");
    bool input = false;
    bool output = false;
    for (const std::string& word : words_) {
        for (auto place = next_place(word, 0); place;
             place = next_place(word, place->begin + place->length)) {
            if (place->name != "input" && place->name != "frames" && !is_output(place->name))
                refuse(text_, "has {" + place->name +
                                  "}: its places are {input} or {frames}, and {output} or "
                                  "{output.EXT}");
            if (word.find_first_of(kSpaces) != std::string::npos)
                refuse(text_, "has {" + place->name +
                                  "} inside a longer text: let it be a word of its own (in sh -c "
                                  "'...' write \"$1\", and the place after it)");
            input = input || place->name == "input";
            takes_frames_ = takes_frames_ || place->name == "frames";
            output = output || is_output(place->name);
        }
    }
    if (!output) refuse(text_, "has no {output}: say where in it the depth goes");
    if (input == takes_frames_)
        refuse(text_, input ? "has both {input} and {frames}: give one of them"
                            : "has neither {input}, the video, nor {frames}, a folder of its "
                              "pictures: give one of them");
}

std::vector<std::string> EstimatorCommand::words(const EstimatorPlaces& places) const {
    std::vector<std::string> filled;
    for (const std::string& word : words_) {
        std::string text;
        std::size_t at = 0;
        for (auto place = next_place(word, 0); place; place = next_place(word, at)) {
            text += word.substr(at, place->begin - at) + path_at(place->name, places);
            at = place->begin + place->length;
        }
        filled.push_back(text + word.substr(at));
    }
    return filled;
}

}  // namespace dibhr
