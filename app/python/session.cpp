// Recorded sessions as plain values, and their ticks as rows of a structured array.
#include "core/session/session.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "app/python/module.hpp"
#include "core/files/plain_text.hpp"
#include "core/sqlite/database.hpp"

namespace py = pybind11;

namespace dibhr {

namespace {

/// A column of the view `tick`: its name, numpy's letter for its kind, its offset in a row.
using Field = std::tuple<std::string, char, std::size_t>;

template <typename Value>
void store(char* to, Value value) noexcept {
    std::memcpy(to, &value, sizeof value);
}

/// NULL becomes NaN, or -1 for an integer.
void write_cell(char* to, char kind, const Statement& row, int column) {
    const bool nothing = !row.has(column);
    if (kind == 'f') {
        store(to, nothing ? std::numeric_limits<double>::quiet_NaN() : row.real(column));
    } else if (kind == 'i') {
        store(to, nothing ? std::int64_t{-1} : row.integer(column));
    } else if (kind == 'b') {
        store(to, row.integer(column) != 0);
    } else {
        std::array<char32_t, 8> name{};
        const std::string text = row.text(column).substr(0, name.size());
        std::transform(text.begin(), text.end(), name.begin(),
                       [](char c) { return static_cast<unsigned char>(c); });
        store(to, name);
    }
}

/// " FROM tick WHERE ...": the ticks of a span of time.
std::string ticks_between(double begin_s, double end_s) {
    const auto bound = [](double t_s) {
        constexpr double kMost = std::numeric_limits<double>::max();  // SQL has no infinity
        return number_text(std::clamp(t_s, -kMost, kMost));
    };
    return " FROM tick WHERE t BETWEEN " + bound(begin_s) + " AND " + bound(end_s);
}

std::int64_t count_ticks(const Session& session, double begin_s, double end_s) {
    // A connection for each call, because threads may share the session.
    const SessionReader reader(session.file());
    Statement query = reader.rows("SELECT count(*)" + ticks_between(begin_s, end_s));
    return query.next() ? query.integer(0) : 0;
}

/// Fills rows from the first on; returns their number.
std::int64_t read_ticks(const Session& session, double begin_s, double end_s,
                        const std::vector<Field>& fields, py::array& rows) {
    std::string names;
    for (const auto& field : fields) {
        names += (names.empty() ? "" : ", ") + std::get<std::string>(field);
    }
    auto* row = static_cast<char*>(rows.mutable_data());
    const auto row_bytes = rows.itemsize();
    const auto most = rows.size();
    const py::gil_scoped_release gil_released;
    const SessionReader reader(session.file());
    Statement query =
        reader.rows("SELECT " + names + ticks_between(begin_s, end_s) + " ORDER BY tick");
    std::int64_t done = 0;
    for (; done < most && query.next(); ++done, row += row_bytes) {
        int column = 0;
        for (const auto& [name, kind, offset] : fields) {
            write_cell(row + offset, kind, query, column++);
        }
    }
    return done;
}

/// Decoded as Python decodes file names, so that a session with any bytes can be opened.
py::object text_of(const std::string& text) {
    return py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefault(text.c_str()));
}

py::object path_of(const SessionMedia& media) {
    return media.file.empty() ? py::none() : text_of(media.file.string());
}

py::dict facts_of(const Session& session) {
    py::dict all;
    for (const auto& [name, fact] : session.facts()) all[text_of(name)] = text_of(fact);
    return all;
}

py::list parameters_of(const Session& session) {
    py::list all;
    for (const SessionParameters& version : session.parameters()) {
        py::dict touch;
        for (const TouchChoice& choice : touch_choices()) {
            touch[keyword_of(choice.name)] = std::string(choice.of(version.touch));
        }
        for (const PlainNumber& number : plain_numbers()) {
            touch[keyword_of(number.name)] = number.of(version.touch);
        }
        touch["max_force"] = version.limits.max_force_newton;
        all.append(py::dict(py::arg("version") = version.version,
                            py::arg("first_tick") = version.first_tick, py::arg("touch") = touch,
                            py::arg("force_enabled") = version.force_enabled,
                            py::arg("bump") = path_of(version.bump)));
    }
    return all;
}

py::list sources_of(const Session& session) {
    py::list all;
    for (const SessionSource& source : session.sources()) {
        py::dict one(py::arg("first_tick") = source.first_tick,
                     py::arg("colour") = path_of(source.colour),
                     py::arg("depth") = path_of(source.depth));
        visit_cleaning(source.source, [&one](std::string_view name, const auto& fact) {
            one[std::string(name).c_str()] = fact;
        });
        all.append(std::move(one));
    }
    return all;
}

py::list marks_of(const Session& session) {
    py::list all;
    for (const SessionMark& mark : session.marks()) {
        all.append(py::dict(py::arg("t") = mark.t_s, py::arg("tag") = text_of(mark.tag),
                            py::arg("text") = text_of(mark.text)));
    }
    return all;
}

}  // namespace

void bind_session(py::module_& module) {
    const auto without_gil = py::call_guard<py::gil_scoped_release>();
    py::class_<Session>(module, "Session")
        .def(py::init<const std::string&>())
        .def("check", &Session::check, without_gil)
        .def("count_ticks", &count_ticks, without_gil)
        .def("read_ticks", &read_ticks)
        .def("facts", &facts_of)
        .def("parameters", &parameters_of)
        .def("sources", &sources_of)
        .def("marks", &marks_of)
        .def("extent",
             [](const Session& session) {
                 return py::make_tuple(session.rows(), session.missing(), session.begin_s(),
                                       session.end_s());
             })
        .def("warning", [](const Session& session) { return text_of(session.warning()); });
}

}  // namespace dibhr
