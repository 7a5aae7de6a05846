// By which number in their header (`PRAGMA application_id`) dibhr's own databases are known.
#pragma once

namespace dibhr {

inline constexpr int kSessionApplicationId = 0x64686170;  ///< "dhap"
inline constexpr int kStudyApplicationId = 0x64687374;    ///< "dhst": a participant's study

}  // namespace dibhr
