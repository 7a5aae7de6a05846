// Steps through a study with simulated answers.
#include "app/commands/study_pilot.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/output.hpp"
#include "app/commands/study_hand.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/spelling.hpp"
#include "core/study/simulated_participant.hpp"

namespace dibhr {

namespace {

constexpr std::string_view kHand = "hand";

double utc_now_s() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

void require_condition(const Protocol& protocol, const std::string& name) {
    if (name.empty() || protocol.condition_named(name) != nullptr) return;
    std::vector<std::string> names;
    names.reserve(protocol.conditions.size());
    for (const Condition& condition : protocol.conditions) names.push_back(condition.name);
    throw InputError("no condition is called " + in_quotes(name) +
                     ", which the pilot is to prefer" + did_you_mean(name, names));
}

}  // namespace

void run_pilot(StudyRun& run, StudyFile& file, const std::string& pilot) {
    const bool with_hand = pilot == kHand || pilot.starts_with(std::string(kHand) + ",");
    const std::string answers =
        with_hand ? pilot.substr(std::min(kHand.size() + 1, pilot.size())) : pilot;
    const SimulatedParticipant who = simulated_participant(answers.empty() ? "guess" : answers);
    require_condition(run.protocol(), who.prefers);
    std::optional<StudyHand> hand;
    if (with_hand) hand.emplace();
    ProgressBar bar(file.identity().participant);
    while (run.step() != StudyStep::finished) {
        if (run.step() == StudyStep::question || run.step() == StudyStep::adjust) {
            const AnsweredTrial answered = run.judged(answer_of(who, run), utc_now_s());
            std::filesystem::path session;
            if (hand) hand->explore(run.trial(), session = file.fresh_session());
            file.add(answered, session);
            run.accept(answered);
            bar.show(run.share_done());
        } else {
            run.go_on();
        }
    }
    file.finish();
}

}  // namespace dibhr
