// Depth images from arrays, and updates like those of `dibhr touch`. The Python package has checked
// all arguments: shapes, types, ranges, finite numbers.
#include "core/haptics/touch.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/python/module.hpp"

namespace py = pybind11;

namespace dibhr {

namespace {

using Levels = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// One or two depth images, and a bump map or none. They never change, so any number of renderers
/// and threads can share them.
class Images {
  public:
    Images(const Levels& from, const std::optional<Levels>& to, double highest_level,
           const std::optional<Levels>& bump)
        : from_{columns_of(from), rows_of(from), highest_level, values_of(from)} {
        if (to) to_ = DepthImage{columns_of(*to), rows_of(*to), highest_level, values_of(*to)};
        // Not scaled in advance: the images may be one of many frames, each touched 30 times.
        if (bump) bump_ = BumpMap{columns_of(*bump), rows_of(*bump), values_of(*bump)};
    }

    [[nodiscard]] DepthSurface at(double blend, const SurfaceShape& shape) const noexcept {
        return {from_, to_ ? *to_ : from_, blend, shape, bump_ ? &*bump_ : nullptr};
    }

  private:
    static int rows_of(const Levels& array) { return static_cast<int>(array.shape(0)); }
    static int columns_of(const Levels& array) { return static_cast<int>(array.shape(1)); }
    static std::vector<float> values_of(const Levels& array) {
        return {array.data(), array.data() + array.size()};
    }

    DepthImage from_;
    std::optional<DepthImage> to_{};
    std::optional<BumpMap> bump_{};
};

/// A row of the results, laid out as TOUCH_ROW of the package.
struct Row {
    double t_s;
    Vec3 goal, proxy, spring_newton, sent_newton;
    bool contact;
    char32_t primitive[8];
    std::int64_t i, j, moves, update_ns;
};

void write_row(Row& row, double t_s, const Touch& touch, std::int64_t update_ns) noexcept {
    const Proxy& proxy = touch.proxy;
    const std::string_view name = name_of(proxy.active.kind);
    row.t_s = t_s;
    row.goal = touch.goal;
    row.proxy = proxy.position;
    row.spring_newton = touch.spring_force_newton;
    row.sent_newton = touch.sent_force_newton;
    row.contact = proxy.contact;
    std::fill(std::copy(name.begin(), name.end(), row.primitive), std::end(row.primitive), U'\0');
    row.i = proxy.active.i;
    row.j = proxy.active.j;
    row.moves = proxy.moves;
    row.update_ns = update_ns;
}

py::tuple tuple_of(Vec3 v) {
    return py::make_tuple(v.x, v.y, v.z);
}

/// One hand: the state that is kept from one update to the next.
class Renderer {
  public:
    /// Returns the fields of the package's Touch, in their order.
    py::tuple update(const Images& images, double blend, const Numbers& goal, double dt_s) {
        const BusyGuard guard(busy_);
        const Touch& touch = step(images.at(blend, parameters_.shape),
                                  {goal.at(0), goal.at(1), goal.at(2)}, next_time(dt_s), dt_s);
        const Proxy& proxy = touch.proxy;
        return py::make_tuple(tuple_of(touch.goal), tuple_of(proxy.position),
                              tuple_of(touch.spring_force_newton),
                              tuple_of(touch.sent_force_newton), proxy.contact, proxy.slipping,
                              name_of(proxy.active.kind), proxy.active.i, proxy.active.j,
                              proxy.moves, name_of(touch.cut), proxy.bound_met);
    }

    /// Fills a Row for each of the N x 3 goals; `blends`: one for all, or one for each.
    void run(const Images& images, const Numbers& blends, const Numbers& goals,
             const std::optional<Numbers>& times_s, double dt_s, py::array& rows) {
        if (rows.itemsize() != sizeof(Row)) throw Error("the rows are not laid out as they should");
        const double* const goal = goals.data();
        const double* const blend = blends.data();
        const bool moving = blends.size() > 1;
        const double* const time_s = times_s ? times_s->data() : nullptr;
        auto* const row = static_cast<Row*>(rows.mutable_data());
        const auto count = static_cast<std::size_t>(rows.size());
        const BusyGuard guard(busy_);
        if (time_s != nullptr && count > 0 && last_t_s_ && *time_s < *last_t_s_) {
            throw InputError("t: begins before the last update; reset() to begin again");
        }
        const py::gil_scoped_release gil_released;
        const double begin_s = next_time(dt_s);
        for (std::size_t k = 0; k < count; ++k) {
            double t_s = begin_s + static_cast<double>(k) * dt_s;
            double step_s = dt_s;
            if (time_s != nullptr) {
                t_s = time_s[k];
                // Recordings may have equal time stamps: that update has the default length.
                const double passed_s = last_t_s_ ? t_s - *last_t_s_ : 0.0;
                if (passed_s > 0.0) step_s = passed_s;
            }
            const DepthSurface surface = images.at(blend[moving ? k : 0], parameters_.shape);
            const Vec3 point{goal[3 * k], goal[3 * k + 1], goal[3 * k + 2]};
            const auto start = std::chrono::steady_clock::now();
            const Touch& touch = step(surface, point, t_s, step_s);
            const std::chrono::nanoseconds spent = std::chrono::steady_clock::now() - start;
            write_row(row[k], t_s, touch, spent.count());
        }
    }

    void reset() {
        const BusyGuard guard(busy_);
        renderer_.reset();
        last_t_s_.reset();
    }

    /// Sets all parameters; each value is in its range.
    void set(const py::dict& keywords) {
        const BusyGuard guard(busy_);
        for (const TouchChoice& choice : touch_choices()) {
            const auto word = keywords[keyword_of(choice.name)].cast<std::string>();
            static_cast<void>(choice.choose(word, parameters_));
        }
        for (const PlainNumber& number : plain_numbers()) {
            number.put(keywords[keyword_of(number.name)].cast<double>(), parameters_);
        }
        keep_in_range(parameters_);
        limits_.max_force_newton = keywords["max_force"].cast<double>();
    }

    /// The elevations at N places (x, y).
    [[nodiscard]] py::array_t<double> elevation(const Images& images, double blend,
                                                const Numbers& x, const Numbers& y) const {
        const DepthSurface surface = images.at(blend, parameters_.shape);
        py::array_t<double> heights(x.size());
        for (py::ssize_t k = 0; k < x.size(); ++k) {
            heights.mutable_at(k) = surface.elevation_at(x.at(k), y.at(k));
        }
        return heights;
    }

  private:
    /// During its life no other thread may call the renderer.
    class BusyGuard {
      public:
        explicit BusyGuard(bool& busy) : busy_(busy) {
            if (std::exchange(busy_, true)) {
                throw BusyError("this renderer is at work in another thread; give each its own");
            }
        }
        ~BusyGuard() { busy_ = false; }
        BusyGuard(const BusyGuard&) = delete;
        BusyGuard& operator=(const BusyGuard&) = delete;

      private:
        bool& busy_;
    };

    const Touch& step(const DepthSurface& surface, Vec3 goal, double t_s, double dt_s) noexcept {
        const SafetyInput input{.dt_s = dt_s, .from_zero = !last_t_s_};
        last_t_s_ = t_s;
        return renderer_.update(surface, goal, parameters_, input, limits_);
    }

    [[nodiscard]] double next_time(double dt_s) const noexcept {
        return last_t_s_ ? *last_t_s_ + dt_s : 0.0;
    }

    TouchParameters parameters_{};
    SafetyLimits limits_{};
    TouchRenderer renderer_{};
    std::optional<double> last_t_s_{};
    bool busy_{false};  ///< protected by Python's interpreter lock
};

}  // namespace

void bind_touch(py::module_& module) {
    module.attr("MAX_FORCE") = SafetyLimits{}.max_force_newton;
    py::class_<Images>(module, "Images")
        .def(py::init<const Levels&, const std::optional<Levels>&, double,
                      const std::optional<Levels>&>());
    py::class_<Renderer>(module, "Renderer")
        .def(py::init<>())
        .def("update", &Renderer::update)
        .def("run", &Renderer::run)
        .def("reset", &Renderer::reset)
        .def("set", &Renderer::set)
        .def("elevation", &Renderer::elevation);
}

}  // namespace dibhr
