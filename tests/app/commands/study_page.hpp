// Two conditions of a study.
#pragma once

#include <string>

namespace dibhr::test {

inline const std::string kTwoConditions = R"([base]
friction = 0.4
[[condition]]
name = "smooth-one"
algorithm = "dibhr"
[[condition]]
name = "other-one"
algorithm = "pga"
)";

}  // namespace dibhr::test
