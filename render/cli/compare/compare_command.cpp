// `aleph compare`: the difference of two pictures or sequences as a table or JSON, and as the exit code.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "render/cli/commands.h"
#include "render/cli/compare/compare_command.h"
#include "render/cli/support/options.h"

namespace aleph {

namespace {

void check_numbers(const CompareSettings& s) {
    if (!(s.share >= 0.0 && s.share <= 100.0)) throw InputError("", "--share", "lies in 0 to 100");
    const std::pair<const char*, double> limits[] = {{"--tolerance", s.tolerance},
                                                     {"--relative", s.relative},
                                                     {"--max-error", s.max_error},
                                                     {"--max-rms", s.max_rms},
                                                     {"--max-relative-mse", s.max_relative_mse},
                                                     {"--max-bias", s.max_bias},
                                                     {"--standard-errors", s.standard_errors.value_or(0.0)}};
    for (const auto& [option, value] : limits) {
        if (value < 0.0) throw InputError("", option, "must not be negative");
    }
}

/// @throws InputError (the option) for a file of another ending, in any case
void require_ending(const char* option, const std::string& file, std::initializer_list<std::string_view> endings) {
    if (file.empty() || std::ranges::find(endings, lower_extension(file)) != endings.end()) return;
    throw InputError(
        "", option,
        fmt::format("'{}': expected a name that ends in {}", printable(file, 400), fmt::join(endings, " or ")));
}

int compare(CompareOptions options) {
    check_numbers(options.settings);
    if (!options.seen.empty() && options.settings.standard_errors)
        throw InputError("", "--standard-errors", "judges in place of the tolerance, as --seen does: give one of them");
    if (!options.seen.empty()) options.settings.tolerance = unlimited;  // visible differences judge in its place
    if (options.seen.empty() && !options.seen_out.empty())
        throw InputError("", "--seen-out", "needs --seen with the reference's maps");
    const bool first = names_sequence(options.first), second = names_sequence(options.second);
    if (first != second) {
        const auto& [sequence, picture] =
            first ? std::pair(options.first, options.second) : std::pair(options.second, options.first);
        std::error_code error;
        throw InputError("", "",
                         std::filesystem::exists(picture, error)
                             ? fmt::format("'{}' is a sequence and '{}' one picture", printable(sequence, 400),
                                           printable(picture, 400))
                             : fmt::format("there is no file or folder '{}'", printable(picture, 400)));
    }
    if (!first && !options.cuts.empty()) throw InputError("", "--cuts", "applies to sequences only");
    require_ending("--diff", options.difference, {".png"});
    require_ending("--seen-out", options.seen_out, {".png", ".exr"});
    try {
        return compare_frames(options);
    } catch (const OutputError& e) {
        throw InputError("", "", e.what());  // 1 says that the pictures differ
    }
}

void add_limits(CLI::App& app, CompareSettings& s) {
    add_number(app, "--max-error", s.max_error, "largest difference of any value, whatever --share allows");
    add_number(app, "--max-rms", s.max_rms, "largest RMS difference of any channel");
    add_number(app, "--max-relative-mse", s.max_relative_mse,
               "largest relative MSE of luminance, less what the reference's noise adds (variance.Y)");
    add_number(app, "--max-bias", s.max_bias, "largest difference of the mean luminances, percent of the reference's");
    add_number(
        app, "--standard-errors", s.standard_errors,
        "judge luminance, in place of the channels, and allow this many standard errors (variance.Y) in addition");
}

constexpr const char* compare_footer =
    "Exit code: 0 the same; 1 different, or a NaN or infinity in either; 2 unreadable, or other sizes or channels, or "
    "a\n"
    "file that cannot be written.\n"
    "variance.Y and error are compared only if --channels names them; samples.Y, records.Y, invalid.Y, cache.count "
    "and\n"
    "cache.radius only if both pictures have them.\n\n"
    "Sequences: 'name.####.exr', in quotes, or folders that hold one numbered sequence. Frames are paired by number.\n"
    "--seen follows differences along the motion in the maps, as the eye follows a surface. Those that change from\n"
    "frame to frame *flicker*, the others *last*; *noticed* weighs pixels by how likely viewers look there "
    "(saliency).\n"
    "It uses contrast sensitivity (castleCSF), masking, and the display that the maps name. One picture alone does "
    "not\n"
    "flicker.\n\n"
    "Examples:\n"
    "  aleph compare new.exr golden.exr --relative 1e-4 --share 0.5 --max-rms 0.001\n"
    "  aleph compare guided.exr dense.exr --threshold maps.exr      which differences would a viewer see?\n"
    "  aleph compare 'guided.####.exr' reference/ --seen maps/ --share 1 --seen-out seen.####.png\n"
    "  aleph compare cached.exr traced.exr --standard-errors 4 --relative 0.1 --share 1 --max-bias 1\n"
    "  aleph compare new/ golden/ --seen golden-maps/ --share 1 --junit results.xml    as tests of golden images\n"
    "  aleph compare a.exr b.exr --channels forward,Z --diff where.png";

}  // namespace

void add_compare_command(CLI::App& app, Command& command) {
    CLI::App* compare_app = app.add_subcommand("compare", "compare two pictures, or two sequences of frames");
    const auto options = std::make_shared<CompareOptions>();
    compare_app->add_option("picture", options->first, "a picture (EXR, PNG, JPEG, HDR), or a sequence")->required();
    compare_app->add_option("reference", options->second, "what it is compared with, of the same kind")->required();
    add_text(*compare_app, "--threshold", "MAPS.exr", options->threshold,
             "an EXR file of `aleph maps`, or the sequence of the reference's maps: the pictures differ where their "
             "luminance differs by more than its threshold.Y; replaces --tolerance and --relative");
    add_text(*compare_app, "--seen", "MAPS.exr", options->seen,
             "an EXR file of `aleph maps`, or the sequence of the reference's maps: the pictures differ where a viewer "
             "who looks there sees a difference; replaces --tolerance and --relative");
    add_text(*compare_app, "--seen-out", "FILE", options->seen_out,
             "write what is seen, flickers and lasts, in just visible differences: three panels (.png), or the "
             "channels seen.Y, flicker.Y and lasting.Y (.exr)");
    CompareSettings& settings = options->settings;
    add_value(*compare_app, "--tolerance", settings.tolerance, "allowed difference, in the channel's unit, 0 and up");
    add_value(*compare_app, "--relative", settings.relative,
              "allowed in addition, as a factor on the reference's value, 0 and up");
    add_value(*compare_app, "--share", settings.share, "percent of the pixels that may differ by more, 0 to 100");
    add_limits(*compare_app, settings);
    add_text(*compare_app, "--channels", "A,B", settings.channels,
             "compare only these channels (Z) or layers (forward); default: all")
        ->delimiter(',')
        ->allow_extra_args(false);
    add_text(*compare_app, "--cuts", "LIST", options->cuts, "frames that begin a new shot: nothing flickers into them");
    add_text(*compare_app, "--diff", "OUT.png", options->difference,
             "write the difference as a picture; white is the largest difference");
    add_text(*compare_app, "--junit", "FILE.xml", options->junit,
             "write the result as JUnit's XML, a test case for each frame, for CI services");
    compare_app->add_flag("--json", options->json, "print JSON in place of the table");
    compare_app->add_flag("-q,--quiet", options->quiet,
                          "print nothing but what --json asks for; the exit code is the result");
    compare_app->footer(compare_footer);
    compare_app->callback([options, &command] { command = [options] { return compare(*options); }; });
}

}  // namespace aleph
