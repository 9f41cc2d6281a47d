// `aleph compare`: the difference of two pictures as a table or JSON, and as the exit code.

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/base/errors.h"
#include "render/cli/commands.h"
#include "render/compare.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

struct CompareOptions {
    std::string first, second, threshold, difference;
    CompareSettings settings;
    bool json = false, quiet = false;
};

Json difference_json(const Difference& d) {
    return {{"max", d.max_abs}, {"rms", d.rms}, {"relative_mse", d.relative_mse}};  // infinity becomes null
}

Json pixels_json(const CompareResult& result, std::size_t count) {
    return {{"pixels", count}, {"percent", result.percent(count)}};
}

Json result_json(const CompareResult& result) {
    Json json{{"same", result.same}, {"size", {result.width, result.height}}, {"all", difference_json(result.all)}};
    json["colour"] = result.colour ? difference_json(*result.colour) : Json();
    json["nan"] = {result.a.nan, result.b.nan};
    json["inf"] = {result.a.inf, result.b.inf};
    json["beyond"] = pixels_json(result, result.beyond);
    json["yee"] = result.yee ? pixels_json(result, *result.yee) : Json();
    json["threshold"] = Json();
    if (const auto& threshold = result.threshold) {
        json["threshold"] = pixels_json(result, threshold->beyond);
        json["threshold"]["worst"] = threshold->worst;
        json["threshold"]["display_white"] = threshold->display_white;
    }
    json["channels"] = Json::array();
    for (const ChannelDifference& channel : result.channels) {
        Json entry{{"name", channel.name}};
        entry.update(difference_json(channel.difference));
        entry["at"] = {channel.x, channel.y};
        entry["beyond"] = channel.beyond;
        json["channels"].push_back(entry);
    }
    return json;
}

void print_row(const std::string& name, const Difference& d, const std::string& place, const std::string& beyond) {
    fmt::print("  {:<24} {:>12.6g} {:>12} {:>12.6g} {:>12.6g} {:>12}\n", printable(name, 24), d.max_abs, place, d.rms,
               d.relative_mse, beyond);
}

void print_pixels(const char* what, const CompareResult& result, std::size_t count, const std::string& note = {}) {
    fmt::print("  {:<24} {} of {} pixels ({:.4g} %){}\n", what, count, result.pixels(), result.percent(count), note);
}

void print_table(const CompareOptions& options, const CompareResult& result) {
    fmt::print("{} against {}: {}x{}\n", options.first, options.second, result.width, result.height);
    fmt::print("  {:<24} {:>12} {:>12} {:>12} {:>12} {:>12}\n", "channel", "max", "at x,y", "RMS", "relative MSE",
               "beyond");
    for (const ChannelDifference& channel : result.channels) {
        print_row(channel.name, channel.difference, fmt::format("{},{}", channel.x, channel.y),
                  fmt::format("{}", channel.beyond));
    }
    if (result.colour) print_row("R, G and B", *result.colour, "", "");
    if (result.a.any() || result.b.any()) {
        fmt::print("  NaN: {} and {}, infinite: {} and {}\n", result.a.nan, result.b.nan, result.a.inf, result.b.inf);
    }
    print_pixels("beyond the tolerance", result, result.beyond);
    if (result.yee) print_pixels("fail Yee's metric", result, *result.yee);
    if (const auto& threshold = result.threshold) {
        print_pixels("beyond the Aleph map", result, threshold->beyond,
                     fmt::format(", at worst {:.4g} thresholds; white is {:g} cd/m2", threshold->worst,
                                 threshold->display_white));
    }
    fmt::print("{}\n", result.same ? "same" : "different");
}

int compare(const CompareOptions& options) {
    const ChannelImage first = read_image(options.first), second = read_image(options.second);
    ChannelImage map;
    if (!options.threshold.empty()) map = read_image(options.threshold);
    const CompareResult result =
        compare_images(first, second, options.settings, options.threshold.empty() ? nullptr : &map);
    if (options.json) {
        fmt::print("{}\n", result_json(result).dump(2));
    } else if (!options.quiet) {
        print_table(options, result);
    }
    if (!options.difference.empty()) write_png(options.difference, difference_picture(first, second, options.settings));
    return result.same ? exit_done : exit_different;
}

}  // namespace

void add_compare_command(CLI::App& app, Command& command) {
    CLI::App* compare_app = app.add_subcommand("compare", "compare two pictures");
    const auto options = std::make_shared<CompareOptions>();
    compare_app->add_option("first", options->first, "a picture: EXR, PNG, JPEG or HDR")->required();
    compare_app->add_option("second", options->second, "the reference")->required();
    compare_app
        ->add_option("--threshold", options->threshold,
                     "an EXR file of `aleph maps`: the pictures differ where their luminance differs by more than its "
                     "threshold.Y; replaces --tolerance and --relative")
        ->type_name("MAPS.exr");
    CompareSettings& settings = options->settings;
    add_value(*compare_app, "--tolerance", settings.tolerance, "allowed difference, in the channel's unit, 0 and up");
    add_value(*compare_app, "--relative", settings.relative,
              "allowed in addition, as a factor on the reference's value, 0 and up");
    add_value(*compare_app, "--share", settings.share, "percent of the pixels that may differ by more, 0 to 100");
    compare_app
        ->add_option("--channels", settings.channels,
                     "compare only these channels (Z) or layers (forward); default: all")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("A,B");
    compare_app
        ->add_option("--diff", options->difference,
                     "write the difference as a picture; white is the largest difference")
        ->type_name("OUT.png");
    compare_app->add_flag("--json", options->json, "print JSON in place of the table");
    compare_app->add_flag("-q,--quiet", options->quiet, "print nothing; the exit code is the result");
    compare_app->footer(
        "Exit code: 0 the same; 1 different, or a NaN or infinity in either; 2 unreadable, or other sizes or "
        "channels.\n\n"
        "Examples:\n"
        "  aleph compare new.exr golden.exr --relative 1e-4 --share 0.5\n"
        "  aleph compare guided.exr dense.exr --threshold maps.exr      which differences would a viewer see?\n"
        "  aleph compare a.exr b.exr --channels forward,Z --diff where.png");
    compare_app->callback([options, &command] {
        command = [options] {
            const CompareSettings& s = options->settings;
            if (s.tolerance < 0.0 || s.relative < 0.0 || s.share < 0.0 || s.share > 100.0) {
                throw InputError("", "", "--tolerance and --relative must not be negative, --share lies in 0 to 100");
            }
            return compare(*options);
        };
    });
}

}  // namespace aleph
