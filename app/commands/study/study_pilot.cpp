// Steps through a study with simulated answers.
#include "app/commands/study/study_pilot.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>

#include "app/commands/output.hpp"
#include "app/commands/study/study_hand.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/spelling.hpp"
#include "core/haptics/enum_names.hpp"
#include "core/realtime/now.hpp"

namespace dibhr {

namespace {

constexpr std::string_view kHand = "hand";

}  // namespace

void require_preferred(const Protocol& protocol, const SimulatedParticipant& who) {
    const std::string& name = who.prefers;
    if (name.empty() || protocol.condition_named(name) != nullptr) return;
    throw InputError("no condition is called " + in_quotes(name) +
                     ", which the pilot is to prefer" +
                     did_you_mean(name, all_names(protocol.conditions)));
}

Pilot parse_pilot(const std::string& text, const Protocol& protocol) {
    Pilot pilot{.has_hand = text == kHand || text.starts_with(std::string(kHand) + ",")};
    const std::string answers =
        pilot.has_hand ? text.substr(std::min(kHand.size() + 1, text.size())) : text;
    pilot.answers = simulated_participant(answers.empty() ? "guess" : answers);
    require_preferred(protocol, pilot.answers);
    return pilot;
}

void run_pilot(StudyRun& run, StudyFile& file, const Pilot& pilot) {
    std::optional<StudyHand> hand;
    if (pilot.has_hand) hand.emplace();
    ProgressBar bar(file.identity().participant);
    while (run.step() != StudyStep::finished) {
        if (run.step() == StudyStep::question || run.step() == StudyStep::adjust) {
            const AnsweredTrial answered = run.judged(answer_of(pilot.answers, run), utc_now_s());
            std::filesystem::path session;
            if (hand) hand->explore(run.trial(), session = file.new_session_file());
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
