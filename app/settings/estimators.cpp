// Names, lines and places of depth estimators.
#include "app/settings/estimators.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "core/files/machine.hpp"
#include "core/video/sources/sidecar.hpp"

namespace dibhr {

namespace fs = std::filesystem;

const Estimator* estimator_named(std::span<const Estimator> estimators, const std::string& name) {
    const auto found = std::ranges::find(estimators, name, &Estimator::name);
    return found == estimators.end() ? nullptr : &*found;
}

std::string toml_of(const Estimator& estimator) {
    std::ostringstream command;
    command << toml::value<std::string>(estimator.command);
    if (estimator.meaning == DepthStatement{}) return estimator.name + " = " + command.str() + "\n";
    std::string line = estimator.name + " = { command = " + command.str();
    std::istringstream facts(toml_of(estimator.meaning));
    for (std::string fact; std::getline(facts, fact);)
        if (!fact.empty() && fact.front() != '[') line += ", " + fact;
    return line + " }\n";
}

std::string estimator_hint() {
    return "If you have installed one, name it: in the settings, or with dibhr depth COLOR --with "
           "\"COMMAND\" --as NAME (dibhr help depth has the commands of some)";
}

fs::path depth_cache_path() {
    return program_folder("XDG_CACHE_HOME", ".cache") / "depth";
}

}  // namespace dibhr
