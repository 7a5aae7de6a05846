// The compiled part of the Python package: its errors, the table of parameters, and the rest.
#include "app/python/module.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <exception>
#include <string>
#include <string_view>
#include <utility>

namespace py = pybind11;

namespace dibhr {

namespace {

/// Raises an error class of the package dibhr.
void raise(const char* name, const std::exception& error) {
    const std::string_view text = error.what();  // a file's name in it may not be UTF-8
    const auto message = py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
        text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace"));
    PyErr_SetObject(py::module_::import("dibhr").attr(name).ptr(), message.ptr());
}

void translate(std::exception_ptr thrown) {
    try {
        std::rethrow_exception(std::move(thrown));
    } catch (const InputError& error) {
        raise("InputError", error);
    } catch (const BusyError& error) {
        raise("BusyError", error);
    } catch (const Error& error) {
        raise("Error", error);
    }
}

/// (name, label, unit, lowest, highest, default, help) of each number and switch.
py::list table_of_numbers() {
    py::list table;
    for (const PlainNumber& number : plain_numbers()) {
        table.append(py::make_tuple(keyword_of(number.name), std::string(number.label),
                                    std::string(number.unit), number.lowest, number.highest,
                                    number.of({}), std::string(number.help)));
    }
    return table;
}

/// (name, names of its values, default) of each choice.
py::list table_of_choices() {
    py::list table;
    for (const TouchChoice& choice : touch_choices()) {
        table.append(py::make_tuple(keyword_of(choice.name), choice.names(),
                                    std::string(choice.standard())));
    }
    return table;
}

}  // namespace

py::str keyword_of(std::string_view name) {
    std::string keyword(name);
    std::replace(keyword.begin(), keyword.end(), '-', '_');
    return keyword;
}

}  // namespace dibhr

PYBIND11_MODULE(_dibhr, module) {
    py::register_exception_translator(&dibhr::translate);
    module.attr("VERSION") = DIBHR_VERSION;
    module.attr("NUMBERS") = dibhr::table_of_numbers();
    module.attr("CHOICES") = dibhr::table_of_choices();
    dibhr::bind_touch(module);
    dibhr::bind_session(module);
}
