// Functions of C libraries that are loaded when one of them is first called. DIBHR_FORWARD defines
// a function of a library, with its declaration from the library's header; the linker takes it, and
// the program needs no such library to start.
#pragma once

#include <cstddef>
#include <tuple>

#include "core/files/module.hpp"

namespace dibhr {

template <typename Returned, typename... Arguments>
struct Signature {
    using Result = Returned;
    template <std::size_t Index>
    using Argument = std::tuple_element_t<Index, std::tuple<Arguments...>>;
};
/// For decltype alone.
template <typename Returned, typename... Arguments>
Signature<Returned, Arguments...> signature_of(Returned (*function)(Arguments...));

}  // namespace dibhr

/// `count` arguments; `module`: the part of its name behind libdibhr_.
#define DIBHR_FORWARD(module, count, name)                                                         \
    extern "C" decltype(::dibhr::signature_of(&name))::Result name(                                \
        DIBHR_ARGUMENTS_##count(name)) {                                                           \
        static const auto loaded =                                                                 \
            reinterpret_cast<decltype(&name)>(::dibhr::symbol_in_module("dibhr_" #module, #name)); \
        return loaded(DIBHR_VALUES_##count);                                                       \
    }

#define DIBHR_ARGUMENT(name, k) decltype(::dibhr::signature_of(&name))::Argument<k> a##k
#define DIBHR_ARGUMENTS_0(name)
#define DIBHR_ARGUMENTS_1(name) DIBHR_ARGUMENT(name, 0)
#define DIBHR_ARGUMENTS_2(name) DIBHR_ARGUMENTS_1(name), DIBHR_ARGUMENT(name, 1)
#define DIBHR_ARGUMENTS_3(name) DIBHR_ARGUMENTS_2(name), DIBHR_ARGUMENT(name, 2)
#define DIBHR_ARGUMENTS_4(name) DIBHR_ARGUMENTS_3(name), DIBHR_ARGUMENT(name, 3)
#define DIBHR_ARGUMENTS_5(name) DIBHR_ARGUMENTS_4(name), DIBHR_ARGUMENT(name, 4)
#define DIBHR_ARGUMENTS_6(name) DIBHR_ARGUMENTS_5(name), DIBHR_ARGUMENT(name, 5)
#define DIBHR_ARGUMENTS_7(name) DIBHR_ARGUMENTS_6(name), DIBHR_ARGUMENT(name, 6)
#define DIBHR_ARGUMENTS_8(name) DIBHR_ARGUMENTS_7(name), DIBHR_ARGUMENT(name, 7)
#define DIBHR_ARGUMENTS_9(name) DIBHR_ARGUMENTS_8(name), DIBHR_ARGUMENT(name, 8)
#define DIBHR_ARGUMENTS_10(name) DIBHR_ARGUMENTS_9(name), DIBHR_ARGUMENT(name, 9)
#define DIBHR_ARGUMENTS_11(name) DIBHR_ARGUMENTS_10(name), DIBHR_ARGUMENT(name, 10)
#define DIBHR_VALUES_0
#define DIBHR_VALUES_1 a0
#define DIBHR_VALUES_2 DIBHR_VALUES_1, a1
#define DIBHR_VALUES_3 DIBHR_VALUES_2, a2
#define DIBHR_VALUES_4 DIBHR_VALUES_3, a3
#define DIBHR_VALUES_5 DIBHR_VALUES_4, a4
#define DIBHR_VALUES_6 DIBHR_VALUES_5, a5
#define DIBHR_VALUES_7 DIBHR_VALUES_6, a6
#define DIBHR_VALUES_8 DIBHR_VALUES_7, a7
#define DIBHR_VALUES_9 DIBHR_VALUES_8, a8
#define DIBHR_VALUES_10 DIBHR_VALUES_9, a9
#define DIBHR_VALUES_11 DIBHR_VALUES_10, a10
