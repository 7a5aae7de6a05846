// Command line options that several commands share, and the error of a wrong command line.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/settings/material.hpp"
#include "core/error.hpp"
#include "core/haptics/enum_names.hpp"
#include "core/haptics/parameters.hpp"
#include "core/plot/canvas.hpp"
#include "core/video/motion/motion_request.hpp"
#include "core/video/sources/media.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace dibhr {

/// The command line itself is wrong; the program ends with 2.
class UsageError : public Error {
  public:
    using Error::Error;
};

/// Parameters and material that the command line gives; they override settings and defaults.
struct GivenParameters {
    std::optional<Material> material{};  ///< --material; numbers given by themselves win
    std::string bump{};                  ///< --bump IMAGE, instead of the material's; empty: none
    std::vector<std::pair<const TouchChoice*, std::string>> words{};
    std::vector<std::pair<const TouchSwitch*, bool>> switches{};
    std::vector<std::pair<const TouchNumber*, double>> numbers{};
    std::optional<double> friction{};  ///< both coefficients, unless one is given by itself
    bool fit_relief{false};            ///< --relief auto
    bool fit_pitch{false};             ///< --pixel-pitch auto

    /// The value given for that entry of touch_numbers(); null: none.
    [[nodiscard]] const double* value_of(const TouchNumber& number) const;
    /// Whether a damping is given, in place of the one that the device needs.
    [[nodiscard]] bool gives_damping() const;
    /// The file of --bump or of the material; empty: none.
    [[nodiscard]] std::filesystem::path bump_file() const;
    /// The bump map of bump_file(); null: none. Throws InputError.
    [[nodiscard]] std::shared_ptr<const BumpMap> read_bumps() const;
    /// Throws UsageError when --dynamic-friction ends above the static coefficient.
    void apply(TouchParameters& parameters) const;
    /// Fits relief and pixel pitch to the media where they are not given as numbers. `raw`: only
    /// where they are given as auto.
    void fit(const MediaDescription& media, bool raw, TouchParameters& parameters) const;

  private:
    /// Roughness and size of the bump map, which depend on the pitch.
    void apply_texture(TouchParameters& parameters) const;
};

/// Options of all commands that compute forces.
struct TouchRequest {
    GivenParameters given{};
    bool raw_depth{false};                    ///< --raw-depth
    std::optional<CleaningPreset> preset{};   ///< --cleaning
    std::optional<double> finger_mm{};        ///< --finger
    std::optional<InBetweens> in_betweens{};  ///< --in-betweens
    Decoder decoder{Decoder::automatic};      ///< --decoder
    DepthStatement depth{};                   ///< --near, --depth-unit and so on
    std::optional<bool> maps{};               ///< --maps

    [[nodiscard]] DepthRequest depth_request() const;
    /// Whether an option changes the surface: bump map, cleaning, fingertip, in-betweens, maps.
    [[nodiscard]] bool changes_surface() const;
    /// Cleaning for a surface of these parameters, which give the fingertip's size in pixels. Unset
    /// options come from the media's sidecar.
    [[nodiscard]] CleaningOptions cleaning(const TouchParameters& parameters,
                                           const MediaDescription& media = {}) const;
    /// Whether the touch maps beside the recording are used.
    [[nodiscard]] bool uses_maps() const noexcept { return maps.value_or(true); }
    /// The maps beside the media that are used; null: none. Throws InputError.
    [[nodiscard]] std::shared_ptr<const TouchMaps> read_maps(const MediaDescription& media) const;
};

/// A finger of that radius on a surface of these parameters.
[[nodiscard]] Fingertip fingertip_of(double radius_mm, const TouchParameters& parameters);

/// Sets a perceptible roughness where a bump map has none.
void ensure_roughness(TouchParameters& parameters);

/// Warning that a roughness is given without a bump map to scale; empty: no warning.
[[nodiscard]] std::string roughness_warning(const GivenParameters& given, bool has_bump);

/// --NAME: passes a finite decimal number in [lowest, highest] to `take`, and refuses all else.
/// The range is added to `help`.
CLI::Option* add_number_option(CLI::App& app, const std::string& name, double lowest,
                               double highest, const std::string& help,
                               const std::function<void(double)>& take);

/// --NAME on|off: passes the value to `take`.
CLI::Option* add_on_off_option(CLI::App& app, const std::string& name, const std::string& help,
                               const std::function<void(bool)>& take);
/// The same into `on`, which must outlive the parsing of `app`.
CLI::Option* add_on_off_option(CLI::App& app, const std::string& name, const std::string& help,
                               std::optional<bool>& on);

/// --NAME with one of `names`; the first is the default.
CLI::Option* add_choice_option(CLI::App& app, const std::string& name,
                               const std::vector<std::string>& names, const std::string& help,
                               const std::function<void(const std::string&)>& take);

/// The same with the names of an enumeration.
template <HasNameTable Enum>
CLI::Option* add_words_option(CLI::App& app, const std::string& name, const std::string& help,
                              const std::function<void(Enum)>& take) {
    return add_choice_option(app, name, all_names<Enum>(), help,
                             [take](const std::string& word) { take(named<Enum>(word).value()); });
}

/// The option of an entry of touch_numbers(): its name, range and default.
CLI::Option* add_touch_option(CLI::App& app, const TouchNumber& number, const std::string& help,
                              const std::function<void(double)>& take);

/// --decoder auto|software. `decoder` must outlive the parsing of `app`.
void add_decoder_option(CLI::App& app, Decoder& decoder);

/// --in-betweens auto|on|off. `touch` must outlive the parsing of `app`.
void add_in_betweens_option(CLI::App& app, TouchRequest& touch);

/// --algorithm NAME, several times. `algorithms` must outlive the parsing of `app`.
void add_algorithms_option(CLI::App& app, std::vector<Algorithm>& algorithms);

/// --plot-format png,svg,pdf. `formats` must outlive the parsing of `app`; it stays as it is when
/// none is given.
CLI::Option* add_plot_format_option(CLI::App& app, std::vector<PlotFormat>& formats);

/// --near, --depth-unit, --depth-scale, --depth-range and --no-data: what depth levels mean.
/// `depth` must outlive the parsing of `app`.
void add_level_options(CLI::App& app, DepthStatement& depth);

/// The same, --packing, --depth-code, --geometry, --intrinsics, --registration, --depth-times,
/// --depth-offset and --depth-fps. `depth` must outlive the parsing of `app`.
void add_depth_options(CLI::App& app, DepthStatement& depth);

/// --sure: whether a meaning of depth that is likely but not sure is a failure. `sure` must outlive
/// the parsing of `app`.
void add_sure_option(CLI::App& app, bool& sure);

/// --material, --bump, --maps, --raw-depth, --cleaning, --finger, those of add_depth_options and
/// the entries of the parameter table that shape a surface. `request` must outlive the parsing of
/// `app`.
void add_shape_options(CLI::App& app, TouchRequest& request);

/// The same, --friction and the other entries of the table, except options that the command already
/// has. The last argument: default shown for choices and switches; null: their own defaults.
void add_touch_options(CLI::App& app, TouchRequest& request, const char* default_text = nullptr);

}  // namespace dibhr
