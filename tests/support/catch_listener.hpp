// The base of listeners to beginnings and ends of runs and cases, for both versions of Catch2.
#pragma once

#include <string>

#if __has_include(<catch2/catch_test_macros.hpp>)
#include <catch2/catch_test_case_info.hpp>
#include <catch2/reporters/catch_reporter_event_listener.hpp>
#include <catch2/reporters/catch_reporter_registrars.hpp>

namespace dibhr::test {

using Listener = Catch::EventListenerBase;

inline std::string name_of(const Catch::TestCaseStats& stats) {
    return stats.testInfo->name;
}

}  // namespace dibhr::test
#else
#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include <catch2/catch.hpp>

namespace dibhr::test {

using Listener = Catch::TestEventListenerBase;

inline std::string name_of(const Catch::TestCaseStats& stats) {
    return stats.testInfo.name;
}

}  // namespace dibhr::test
#endif
