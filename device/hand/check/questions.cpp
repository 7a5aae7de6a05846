// Questions to the user of a device check.
#include "device/hand/check/questions.hpp"

#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

bool is_letter(const std::string& line, char letter) {
    return line.size() == 1 && (line[0] == letter || line[0] == letter - 'a' + 'A');
}

}  // namespace

void CheckQuestions::quit_if_interrupted() const {
    if (console.interrupted()) throw PersonQuits{};
}

std::optional<std::string> CheckQuestions::typed() {
    quit_if_interrupted();
    auto line = console.next_line();
    if (line && is_letter(*line, 'q')) throw PersonQuits{};
    if (line && is_letter(*line, 's')) throw StepSkipped{};
    return line;
}

bool CheckQuestions::answered() {
    const bool any = typed().has_value();
    if (!any && console.input_ended()) throw StepSkipped{};
    return any;
}

std::optional<std::string> CheckQuestions::line() {
    for (;;) {
        if (auto line = typed()) return line;
        if (console.input_ended()) return std::nullopt;
        keep_alive();
    }
}

void CheckQuestions::begin(const std::string& question) {
    console.ask(question);
    (void)line();
}

std::string CheckQuestions::word(const std::string& question) {
    console.ask(question);
    auto typed_word = line();
    if (!typed_word) throw StepSkipped{};
    return *typed_word;
}

void CheckQuestions::agree_to_force(const std::string& question) {
    while (!is_letter(word(question), 'f')) console.print("There is no force until you type F.");
}

bool CheckQuestions::yes_or_no(const std::string& question) {
    for (;;) {
        const std::string answer = word(question + " y or n");
        if (is_letter(answer, 'y') || answer == "yes") return true;
        if (is_letter(answer, 'n') || answer == "no") return false;
        console.print("y or n, please, or s to skip this step");
    }
}

std::optional<double> CheckQuestions::number(const std::string& question, double lowest,
                                             double highest) {
    for (;;) {
        const std::string text = word(question);
        if (text.empty()) return std::nullopt;
        const auto value = number_of_text(text);
        if (value && *value >= lowest && *value <= highest) return value;
        console.print("a number from " + number_text(lowest, 0) + " to " + number_text(highest, 0) +
                      ", please, or Enter alone when there is none");
    }
}

}  // namespace dibhr
