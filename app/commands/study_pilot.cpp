// Steps through a study with simulated answers.
#include "app/commands/study_pilot.hpp"

#include <chrono>

#include "app/commands/output.hpp"
#include "core/study/simulated_participant.hpp"

namespace dibhr {

namespace {

double utc_now_s() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

}  // namespace

void run_pilot(StudyRun& run, StudyFile& file, const std::string& pilot) {
    const SimulatedParticipant who = simulated_participant(pilot);
    ProgressBar bar(file.identity().participant);
    while (run.step() != StudyStep::finished) {
        if (run.step() == StudyStep::question || run.step() == StudyStep::adjust) {
            const AnsweredTrial answered = run.judged(answer_of(who, run), utc_now_s());
            file.add(answered);
            run.accept(answered);
            bar.show(run.share_done());
        } else {
            run.go_on();
        }
    }
    file.finish();
}

}  // namespace dibhr
