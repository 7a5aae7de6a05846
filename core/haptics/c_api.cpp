// dibhr.h over the C++ core: checks what it is given, and lets no exception out.
#include <array>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "core/haptics/dibhr.h"
#include "core/haptics/parameters.hpp"
#include "core/haptics/touch.hpp"

struct dibhr_handle {
    dibhr::DepthImage from{};
    dibhr::DepthImage to{};
    bool has_two{false};
    // Takes the place of `from` or `to` once it is whole.
    std::array<dibhr::DepthImage, 2> being_read{};
    double blend{0.0};
    std::optional<dibhr::BumpMap> bump{};
    dibhr::TouchParameters parameters{};
    dibhr::SafetyLimits limits{};
    dibhr::SafetyInput input{};
    dibhr::TouchRenderer renderer{};
    dibhr::Touch last{};
    mutable std::array<char, 160> error{};
};

namespace {

using namespace dibhr;

/// Stores the error's text in the handle, and returns the status.
__attribute__((format(printf, 3, 4))) dibhr_status failed(const dibhr_handle* handle,
                                                          dibhr_status status, const char* format,
                                                          ...) noexcept {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(handle->error.data(), handle->error.size(), format, arguments);
    va_end(arguments);
    return status;
}

/// As %g shows it, with a decimal point whatever the host's locale.
class NumberText {
  public:
    explicit NumberText(double number) noexcept {
        std::to_chars(text_.data(), text_.data() + text_.size() - 1, number,
                      std::chars_format::general, 6);
    }
    [[nodiscard]] const char* text() const noexcept { return text_.data(); }

  private:
    std::array<char, 16> text_{};  // "-1.23457e-308"
};

dibhr_status null_given(const dibhr_handle* handle, const char* what) noexcept {
    return failed(handle, DIBHR_BAD_ARGUMENT, "%s is NULL", what);
}

float highest_of(const dibhr_image& image) noexcept {
    if (image.highest_level != 0.0) return static_cast<float>(image.highest_level);
    if (image.type == DIBHR_LEVELS_8_BIT) return 255.0F;
    if (image.type == DIBHR_LEVELS_16_BIT) return 65535.0F;
    return 1.0F;
}

std::size_t bytes_of_level(int type) noexcept {
    return type == DIBHR_LEVELS_8_BIT ? 1 : type == DIBHR_LEVELS_16_BIT ? 2 : sizeof(float);
}

template <typename Level>
bool copy_levels(const dibhr_image& image, std::size_t row_bytes, std::vector<float>& levels) {
    const auto columns = static_cast<std::size_t>(image.columns);
    const float highest = highest_of(image);
    levels.resize(columns * static_cast<std::size_t>(image.rows));
    auto out = levels.begin();
    for (int j = 0; j < image.rows; ++j) {
        const unsigned char* next = static_cast<const unsigned char*>(image.levels) +
                                    static_cast<std::size_t>(j) * row_bytes;
        for (std::size_t i = 0; i < columns; ++i, ++out, next += sizeof(Level)) {
            Level level;
            std::memcpy(&level, next, sizeof level);  // may lie at any address
            *out = static_cast<float>(level);
            if (!(*out >= 0.0F && *out <= highest)) return false;
        }
    }
    return true;
}

/// Checks the image and copies its levels. `levels` may hold anything after a failure.
dibhr_status read_image(const dibhr_handle* handle, const dibhr_image* image, int smallest,
                        std::vector<float>& levels) noexcept try {
    if (image == nullptr || image->levels == nullptr) return null_given(handle, "the image");
    if (image->columns < smallest || image->rows < smallest) {
        return failed(handle, DIBHR_BAD_ARGUMENT,
                      "an image of %d x %d: it must have at least %d x %d", image->columns,
                      image->rows, smallest, smallest);
    }
    if (image->type < DIBHR_LEVELS_8_BIT || image->type > DIBHR_LEVELS_FLOAT) {
        return failed(handle, DIBHR_BAD_ARGUMENT, "unknown type of levels: %d", image->type);
    }
    const float highest = highest_of(*image);
    if (!(highest > 0.0F) || !std::isfinite(highest)) {
        return failed(handle, DIBHR_BAD_ARGUMENT,
                      "a highest level of %s: it must be above 0, and finite as a float",
                      NumberText(image->highest_level).text());
    }
    const std::size_t packed =
        static_cast<std::size_t>(image->columns) * bytes_of_level(image->type);
    const std::size_t row_bytes = image->row_bytes == 0 ? packed : image->row_bytes;
    if (row_bytes < packed || row_bytes % bytes_of_level(image->type) != 0) {
        return failed(handle, DIBHR_BAD_ARGUMENT, "rows of %zu bytes do not hold %d levels",
                      row_bytes, image->columns);
    }
    const bool all_in_range =
        image->type == DIBHR_LEVELS_8_BIT    ? copy_levels<std::uint8_t>(*image, row_bytes, levels)
        : image->type == DIBHR_LEVELS_16_BIT ? copy_levels<std::uint16_t>(*image, row_bytes, levels)
                                             : copy_levels<float>(*image, row_bytes, levels);
    if (all_in_range) return DIBHR_OK;
    return failed(handle, DIBHR_BAD_ARGUMENT, "a level is not in 0 to %s",
                  NumberText(highest).text());
} catch (const std::exception&) {  // bad_alloc, or a size that no vector can have
    return failed(handle, DIBHR_NO_MEMORY, "no memory for %d x %d levels", image->columns,
                  image->rows);
}

dibhr_status read_depth(const dibhr_handle* handle, const dibhr_image* image,
                        DepthImage& depth) noexcept {
    const dibhr_status status = read_image(handle, image, 2, depth.levels);
    if (status != DIBHR_OK) return status;
    depth.columns = image->columns;
    depth.rows = image->rows;
    depth.highest_level = highest_of(*image);
    return DIBHR_OK;
}

bool have_same_size(const DepthImage& a, const DepthImage& b) noexcept {
    return a.columns == b.columns && a.rows == b.rows && a.highest_level == b.highest_level;
}

bool has_surface(const dibhr_handle* handle) noexcept {
    return handle->from.columns > 0;
}

dibhr_status no_surface(const dibhr_handle* handle) noexcept {
    return failed(handle, DIBHR_NO_SURFACE, "there is no depth image yet");
}

/// Makes an update over the bump map faster; without memory it works as well.
void stretch_bump(dibhr_handle& handle) noexcept {
    const DepthImage& depth = handle.from;
    const double size_px = handle.parameters.shape.bump_size_px;
    if (!handle.bump || is_stretched(*handle.bump, depth.columns, depth.rows, size_px)) return;
    try {
        stretch(*handle.bump, depth.columns, depth.rows, size_px);
    } catch (const std::exception&) {  // no memory: it stays as it was
    }
}

dibhr_status different_size(const dibhr_handle* handle) noexcept {
    return failed(handle, DIBHR_BAD_ARGUMENT,
                  "the two depth images are not of the same size and highest level");
}

DepthSurface surface_of(const dibhr_handle& handle) noexcept {
    return {handle.from, handle.has_two ? handle.to : handle.from, handle.blend,
            handle.parameters.shape, handle.bump ? &*handle.bump : nullptr};
}

void copy(const Vec3& from, double (&to)[3]) noexcept {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

dibhr_touch as_c(const Touch& touch) noexcept {
    dibhr_touch c{};
    copy(touch.goal, c.goal);
    copy(touch.proxy.position, c.proxy);
    copy(touch.spring_force_newton, c.spring_force);
    copy(touch.sent_force_newton, c.sent_force);
    c.contact = touch.proxy.contact ? 1 : 0;
    c.slipping = touch.proxy.slipping ? 1 : 0;
    c.primitive = static_cast<dibhr_primitive>(touch.proxy.active.kind);
    c.i = touch.proxy.active.i;
    c.j = touch.proxy.active.j;
    c.moves = touch.proxy.moves;
    c.bound_met = touch.proxy.bound_met ? 1 : 0;
    c.cut = name_of(touch.cut);
    return c;
}

/// The table's entry of this name; null, and the reason kept, if there is none.
const PlainNumber* entry_named(const dibhr_handle* handle, const char* name) noexcept {
    for (const PlainNumber& entry : plain_numbers())
        if (entry.name == name) return &entry;
    failed(handle, DIBHR_UNKNOWN_NAME, "no parameter is called \"%s\"", name);
    return nullptr;
}

static_assert(static_cast<int>(PrimitiveKind::triangle) == DIBHR_TRIANGLE &&
              static_cast<int>(PrimitiveKind::edge) == DIBHR_EDGE &&
              static_cast<int>(PrimitiveKind::vertex) == DIBHR_VERTEX);

}  // namespace

extern "C" {

const char* dibhr_version(void) {
    return DIBHR_VERSION;
}

dibhr_handle* dibhr_create(void) {
    try {
        return new dibhr_handle;
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

void dibhr_destroy(dibhr_handle* handle) {
    delete handle;
}

const char* dibhr_last_error(const dibhr_handle* handle) {
    return handle == nullptr ? "the handle is NULL" : handle->error.data();
}

dibhr_status dibhr_set_depth(dibhr_handle* handle, const dibhr_image* from, const dibhr_image* to) {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    auto& [new_from, new_to] = handle->being_read;
    dibhr_status status = read_depth(handle, from, new_from);
    if (status == DIBHR_OK && to != nullptr) status = read_depth(handle, to, new_to);
    if (status != DIBHR_OK) return status;
    if (to != nullptr && !have_same_size(new_from, new_to)) return different_size(handle);
    std::swap(handle->from, new_from);
    if (to != nullptr) std::swap(handle->to, new_to);
    handle->has_two = to != nullptr;
    stretch_bump(*handle);
    handle->blend = 0.0;
    handle->input.from_zero = true;
    return DIBHR_OK;
}

dibhr_status dibhr_push_depth(dibhr_handle* handle, const dibhr_image* next) {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    if (!has_surface(handle)) return no_surface(handle);
    DepthImage& new_to = handle->being_read[0];
    const dibhr_status status = read_depth(handle, next, new_to);
    if (status != DIBHR_OK) return status;
    if (!have_same_size(handle->from, new_to)) return different_size(handle);
    if (handle->has_two) std::swap(handle->from, handle->to);
    std::swap(handle->to, new_to);
    handle->has_two = true;
    handle->blend = 0.0;
    return DIBHR_OK;
}

dibhr_status dibhr_set_blend(dibhr_handle* handle, double blend) {
    if (!(blend >= 0.0 && blend <= 1.0)) {
        return failed(handle, DIBHR_BAD_ARGUMENT, "a blend of %s: it must be from 0 to 1",
                      NumberText(blend).text());
    }
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    handle->blend = blend;
    return DIBHR_OK;
}

dibhr_status dibhr_set_bump(dibhr_handle* handle, const dibhr_image* bump) {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    if (bump == nullptr) {
        handle->bump.reset();
        return DIBHR_OK;
    }
    BumpMap read;
    const dibhr_status status = read_image(handle, bump, 1, read.heights);
    if (status != DIBHR_OK) return status;
    read.columns = bump->columns;
    read.rows = bump->rows;
    const float highest = highest_of(*bump);
    for (float& height : read.heights) height /= highest;
    handle->bump = std::move(read);
    stretch_bump(*handle);
    return DIBHR_OK;
}

dibhr_status dibhr_elevation(const dibhr_handle* handle, double x, double y, double* z) {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    if (z == nullptr) return null_given(handle, "z");
    if (!has_surface(handle)) return no_surface(handle);
    if (!is_finite({x, y, 0.0})) return failed(handle, DIBHR_BAD_ARGUMENT, "x or y is not finite");
    *z = surface_of(*handle).elevation_at(x, y);
    return DIBHR_OK;
}

size_t dibhr_parameter_count(void) {
    return plain_numbers().size();
}

dibhr_status dibhr_parameter_at(size_t index, dibhr_parameter* parameter) {
    if (index >= plain_numbers().size() || parameter == nullptr) return DIBHR_BAD_ARGUMENT;
    const PlainNumber& entry = plain_numbers()[index];  // its texts are literals: they end with a 0
    *parameter = {entry.name.data(), entry.unit.data(), entry.help.data(),
                  entry.lowest,      entry.highest,     entry.of({})};
    return DIBHR_OK;
}

dibhr_status dibhr_set(dibhr_handle* handle, const char* name, double value) {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    if (name == nullptr) return null_given(handle, "the name");
    const PlainNumber* entry = entry_named(handle, name);
    if (entry == nullptr) return DIBHR_UNKNOWN_NAME;
    if (!(value >= entry->lowest && value <= entry->highest)) {
        return failed(handle, DIBHR_OUT_OF_RANGE, "%s = %s: it must be from %s to %s %s", name,
                      NumberText(value).text(), NumberText(entry->lowest).text(),
                      NumberText(entry->highest).text(), entry->unit.data());
    }
    entry->put(value, handle->parameters);
    return DIBHR_OK;
}

dibhr_status dibhr_get(const dibhr_handle* handle, const char* name, double* value) {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    if (name == nullptr || value == nullptr) return null_given(handle, "the name or the value");
    const PlainNumber* entry = entry_named(handle, name);
    if (entry == nullptr) return DIBHR_UNKNOWN_NAME;
    *value = entry->of(handle->parameters);
    return DIBHR_OK;
}

const char* dibhr_algorithm_at(size_t index) {
    return index < all_algorithms().size() ? name_of(all_algorithms()[index]) : nullptr;
}

dibhr_status dibhr_set_algorithm(dibhr_handle* handle, const char* name) {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    if (name == nullptr) return null_given(handle, "the name");
    const auto algorithm = named<Algorithm>(name);
    if (!algorithm)
        return failed(handle, DIBHR_UNKNOWN_NAME, "no algorithm is called \"%s\"", name);
    handle->parameters.algorithm = *algorithm;
    return DIBHR_OK;
}

const char* dibhr_algorithm(const dibhr_handle* handle) {
    return handle == nullptr ? nullptr : name_of(handle->parameters.algorithm);
}

dibhr_status dibhr_get_safety(const dibhr_handle* handle, dibhr_safety* safety) {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    if (safety == nullptr) return null_given(handle, "safety");
    const SafetyLimits& limits = handle->limits;
    *safety = {limits.max_force_newton, limits.max_change_newton_per_ms, limits.ramp_s,
               limits.max_tick_s, limits.max_goal_speed_mm_per_ms};
    return DIBHR_OK;
}

dibhr_status dibhr_set_safety(dibhr_handle* handle, const dibhr_safety* safety) {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    if (safety == nullptr) return null_given(handle, "safety");
    for (const double limit :
         {safety->max_force_newton, safety->max_change_newton_per_ms, safety->ramp_s,
          safety->max_tick_s, safety->max_goal_speed_mm_per_ms}) {
        if (!(limit >= 0.0 && std::isfinite(limit))) {
            return failed(handle, DIBHR_BAD_ARGUMENT,
                          "a limit of %s: it must be at least 0 and finite",
                          NumberText(limit).text());
        }
    }
    SafetyLimits& limits = handle->limits;
    limits.max_force_newton = safety->max_force_newton;
    limits.max_change_newton_per_ms = safety->max_change_newton_per_ms;
    limits.ramp_s = safety->ramp_s;
    limits.max_tick_s = safety->max_tick_s;
    limits.max_goal_speed_mm_per_ms = safety->max_goal_speed_mm_per_ms;
    return DIBHR_OK;
}

dibhr_status dibhr_enable_force(dibhr_handle* handle, int enabled) {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    handle->input.force_enabled = enabled != 0;
    return DIBHR_OK;
}

dibhr_status dibhr_update(dibhr_handle* handle, double x, double y, double z, double dt_s,
                          dibhr_touch* touch) {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    if (!has_surface(handle)) return no_surface(handle);
    TouchParameters parameters = handle->parameters;
    keep_in_range(parameters);  // dynamic friction at most static friction
    handle->input.dt_s = dt_s;
    handle->last = handle->renderer.update(surface_of(*handle), {x, y, z}, parameters,
                                           handle->input, handle->limits);
    if (touch != nullptr) *touch = as_c(handle->last);
    if (!is_finite({x, y, z})) return failed(handle, DIBHR_BAD_ARGUMENT, "the goal is not finite");
    handle->input.from_zero = false;
    return DIBHR_OK;
}

dibhr_status dibhr_read(const dibhr_handle* handle, dibhr_touch* touch) {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    if (touch == nullptr) return null_given(handle, "touch");
    *touch = as_c(handle->last);
    return DIBHR_OK;
}

dibhr_status dibhr_reset(dibhr_handle* handle) {
    if (handle == nullptr) return DIBHR_BAD_ARGUMENT;
    handle->renderer.reset();
    handle->last = {};
    return DIBHR_OK;
}

const char* dibhr_primitive_name(dibhr_primitive primitive) {
    return name_of(static_cast<PrimitiveKind>(primitive));
}

}  // extern "C"
