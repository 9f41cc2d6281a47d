#include "render/cli/compare/compare_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "render/cli/scene_options.h"
#include "render/cli/support/command.h"
#include "render/cli/support/output_path.h"
#include "render/cli/support/progress.h"
#include "render/settings/frame_pattern.h"

namespace aleph {

namespace {

/// The frames of a sequence; of a picture frame 0.
FrameFiles find_frames(const std::string& argument, const std::string& option) {
    if (!names_sequence(argument)) return {{0, argument}};
    std::error_code error;
    return std::filesystem::is_directory(argument, error) ? find_folder_frames(argument, option)
                                                          : find_frame_files(argument, option);
}

/// @throws InputError naming all frames that are not everywhere
void check_partners(const CompareOptions& options, const FrameFiles& first, const FrameFiles& second,
                    const FrameFiles& thresholds, const FrameFiles& seen) {
    std::string missing;
    const auto add = [&](const FrameFiles& files, const FrameFiles& others, const std::string& where) {
        std::vector<int> frames;
        for (const auto& [frame, file] : files) {
            if (!where.empty() && !others.contains(frame)) frames.push_back(static_cast<int>(frame));
        }
        if (frames.empty()) return;
        missing += fmt::format("{}'{}' has no frame {}", missing.empty() ? "" : "; ", printable(where, 200),
                               printable(format_frame_list(frames), 200));
    };
    add(first, second, options.second);
    add(second, first, options.first);
    add(first, thresholds, options.threshold);
    add(first, seen, options.seen);
    if (!missing.empty()) throw InputError("", "", missing);
}

/// The maps of every frame; a single file serves a sequence of one frame. Nothing without the option.
FrameFiles find_maps(const CompareOptions& options, const std::string& argument, const std::string& option,
                     const FrameFiles& first) {
    if (argument.empty()) return {};
    if (names_sequence(argument)) {
        if (names_sequence(options.first)) return find_frames(argument, option);
        throw InputError("", option,
                         fmt::format("'{}' is a sequence of maps and '{}' one picture: name the file of its maps",
                                     printable(argument, 400), printable(options.first, 400)));
    }
    if (first.size() > 1) {
        throw InputError("", option,
                         "one file cannot serve several frames: give a pattern or a folder of `aleph maps`");
    }
    return {{first.begin()->first, argument}};
}

/// The file of a frame's picture, of two pictures as it is named; empty without the option.
std::string output_file(const CompareOptions& options, const std::string& pattern, const std::string& option,
                        std::int64_t frame) {
    if (pattern.empty() || !names_sequence(options.first)) return pattern;
    const auto field = find_number_field(pattern, option);
    if (!field) throw InputError("", option, "several frames need a name such as diff.####.png");
    return insert_number(pattern, *field, static_cast<int>(frame));
}

/// No frame's picture replaces a file of any frame, and all can be written: their folders are made.
void check_outputs(const CompareOptions& options, const std::vector<const FrameFiles*>& inputs) {
    std::vector<std::filesystem::path> read;
    for (const FrameFiles* files : inputs) {
        for (const auto& [frame, file] : *files) read.push_back(file);
    }
    std::vector<OutputFile> outputs;
    for (const auto& [frame, file] : *inputs.front()) {
        outputs.push_back({output_file(options, options.difference, "--diff", frame), "--diff"});
        outputs.push_back({output_file(options, options.seen_out, "--seen-out", frame), "--seen-out"});
    }
    outputs.push_back({options.junit, "--junit"});
    refuse_overwriting(read, outputs);
    for (const OutputFile& output : outputs) {
        if (!output.path.empty()) try_output(output.path);
    }
}

/// The table follows, so a log needs no lines of progress.
ProgressLook terminal_look(bool quiet) {
    ProgressLook look = progress_look(quiet);
    if (look.style == ProgressStyle::lines) look.style = ProgressStyle::none;
    return look;
}

/// The whole picture, relative to the first pixel of what the file has of it.
PictureArea find_whole(const ChannelImage& image) {
    const Image<float>& first = image.channels.front().values;
    return image.whole.value_or(PictureArea{0, 0, first.width, first.height});
}

/// Cuts pictures and maps to the window that all of them have. Those of other sizes are left as they are, to be
/// refused.
/// @throws InputError if they have no pixel in common
void cut_to_common_window(const std::vector<ChannelImage*>& images) {
    const PictureArea whole = find_whole(*images.front());
    glm::ivec2 first(-whole.x, -whole.y), end(std::numeric_limits<int>::max());
    for (const ChannelImage* image : images) {
        const PictureArea own = find_whole(*image);
        if (own.width != whole.width || own.height != whole.height) return;
        const Image<float>& values = image->channels.front().values;
        first = glm::max(first, -glm::ivec2(own.x, own.y));
        end = glm::min(end, glm::ivec2(values.width, values.height) - glm::ivec2(own.x, own.y));
    }
    const glm::ivec2 size = end - first;
    if (size.x <= 0 || size.y <= 0)
        throw InputError("", "", "the pictures are windows of one that have no pixel in common");
    for (ChannelImage* image : images) {
        const PictureArea own = find_whole(*image);
        for (Channel& channel : image->channels)
            channel.values = crop(channel.values, {first.x + own.x, first.y + own.y, size.x, size.y});
    }
}

struct JunitCase {
    std::string name;
    std::string failure;  ///< why the test failed; empty: it passed
};

/// Text for an attribute of XML. Control characters, which XML 1.0 cannot hold, are escaped as in messages.
std::string escape_xml(const std::string& text) {
    constexpr std::string_view characters = "&<>\"";
    constexpr const char* names[] = {"&amp;", "&lt;", "&gt;", "&quot;"};
    std::string out;
    for (const char c : printable(text, 1000)) {
        const std::size_t at = characters.find(c);
        out += at == std::string_view::npos ? std::string(1, c) : names[at];
    }
    return out;
}

/// One test case of two pictures, in words.
JunitCase make_junit_case(const std::string& name, const FrameComparison& comparison, const CompareSettings& settings) {
    const auto& [frame, result, visible, same] = comparison;
    JunitCase test{name, {}};
    if (same) return test;
    const auto add = [&](const std::string& reason) { test.failure += (test.failure.empty() ? "" : "; ") + reason; };
    if (result.a.any() || result.b.any())
        add(fmt::format("{} values are NaN, {} infinite", result.a.nan + result.b.nan, result.a.inf + result.b.inf));
    if (visible)
        add(fmt::format("{:.3g} % of the pixels are seen to differ, allowed {:g} %", visible->seen, settings.share));
    if (result.threshold)
        add(fmt::format("{:.3g} % of the pixels are beyond their threshold", result.threshold->percent_beyond()));
    if (!visible && !result.threshold)
        add(fmt::format("{:.3g} % of the pixels are beyond the tolerance{}, allowed {:g} %",
                        result.percent(result.counted), settings.standard_errors ? " and standard errors" : "",
                        settings.share));
    if (const std::string options = exceeded_options(result); !options.empty()) add("exceeded: " + options);
    const auto worst = std::ranges::max_element(
        result.channels, {}, [](const ChannelDifference& channel) { return channel.difference.max_abs; });
    if (worst != result.channels.end()) {
        add(fmt::format("largest difference {:.4g} in {} at {},{}", worst->difference.max_abs, worst->name, worst->x,
                        worst->y));
    }
    return test;
}

/// Writes one test suite of JUnit's XML, which CI services show.
void write_junit(const std::filesystem::path& path, const std::vector<JunitCase>& cases) {
    const auto failures = std::ranges::count_if(cases, [](const JunitCase& test) { return !test.failure.empty(); });
    std::string text = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{0}\" failures=\"{1}\">\n"
        "  <testsuite name=\"aleph compare\" tests=\"{0}\" failures=\"{1}\">\n",
        cases.size(), failures);
    for (const JunitCase& test : cases) {
        text += fmt::format("    <testcase classname=\"aleph compare\" name=\"{}\"", escape_xml(test.name));
        text += test.failure.empty()
                    ? "/>\n"
                    : fmt::format(">\n      <failure message=\"{}\"/>\n    </testcase>\n", escape_xml(test.failure));
    }
    write_file(path, text + "  </testsuite>\n</testsuites>\n");
}

/// Files of the frames: of two sequences and, where they are given, of maps.
struct ComparedFiles {
    FrameFiles first, second, thresholds, seen;
};

/// @throws InputError naming the file, if it has no such channel
ChannelImage read_maps(const std::filesystem::path& file, const char* option, const std::string& channel) {
    ChannelImage maps = read_image(file);
    if (!maps.find(channel))
        throw InputError(printable(file.string(), 400), option,
                         fmt::format("has no channel '{}': give files of `aleph maps`", channel));
    return maps;
}

/// Compares one frame, and writes its picture of differences.
/// @throws InputError, OutputError
void add_frame(const CompareOptions& options, const ComparedFiles& files, std::int64_t frame,
               SequenceComparison& sequence) {
    const std::filesystem::path& file = files.first.at(frame);
    ChannelImage a = read_image(file), b = read_image(files.second.at(frame)), threshold, visible;
    std::vector<ChannelImage*> all{&a, &b};
    SequenceMaps maps;
    if (!files.thresholds.empty()) {
        threshold = read_maps(files.thresholds.at(frame), "--threshold", "threshold.Y");
        all.push_back(&threshold);
        maps.threshold = &threshold;
    }
    if (!files.seen.empty()) {
        visible = read_maps(files.seen.at(frame), "--seen", "forward.u");
        all.push_back(&visible);
        maps.visible = &visible;
    }
    try {
        cut_to_common_window(all);
        sequence.add(frame, a, b, maps);
    } catch (const InputError& e) {
        if (!names_sequence(options.first)) throw;
        throw InputError(printable(file.string(), 400), e.place(), e.reason());
    }
    if (!options.difference.empty())
        write_png(output_file(options, options.difference, "--diff", frame),
                  difference_picture(a, b, options.settings));
}

}  // namespace

bool names_sequence(const std::string& argument) {
    std::error_code error;
    if (std::filesystem::is_directory(argument, error)) return true;
    if (std::filesystem::exists(argument, error)) return false;
    return find_number_field(std::filesystem::path(argument).filename().string(), printable(argument)).has_value();
}

int compare_frames(const CompareOptions& options) {
    const bool is_sequence = names_sequence(options.first);
    ComparedFiles files{find_frames(options.first, "picture"), find_frames(options.second, "reference"), {}, {}};
    files.thresholds = find_maps(options, options.threshold, "--threshold", files.first);
    files.seen = find_maps(options, options.seen, "--seen", files.first);
    check_partners(options, files.first, files.second, files.thresholds, files.seen);
    check_outputs(options, {&files.first, &files.second, &files.thresholds, &files.seen});
    const FrameRange range{files.first.begin()->first, files.first.rbegin()->first};
    const std::vector<std::int64_t> cuts = read_cuts(options.cuts, range, options.quiet);
    SequenceComparison sequence(options.settings, cuts, [&](const VisibleMaps& visible) {
        if (!options.seen_out.empty())
            write_seen(output_file(options, options.seen_out, "--seen-out", visible.frame), visible);
    });
    const auto write_results = [&](std::vector<JunitCase> refused) {
        if (options.junit.empty()) return;
        std::vector<JunitCase> cases;
        for (const FrameComparison& frame : sequence.frames())
            cases.push_back(make_junit_case(files.first.at(frame.frame).string(), frame, options.settings));
        std::ranges::move(refused, std::back_inserter(cases));
        write_junit(options.junit, cases);
    };
    {
        Progress progress("compare", static_cast<double>(files.first.size()),
                          terminal_look(options.quiet || !is_sequence));
        for (const auto& [frame, file] : files.first) {
            try {
                add_frame(options, files, frame, sequence);
            } catch (const InputError& e) {
                write_results({{file.string(), e.what()}});  // results of an earlier run must not stay
                throw;
            }
            progress.update(static_cast<double>(sequence.frames().size()), fmt::format("frame {}", frame));
        }
        sequence.finish();
    }
    write_results({});
    const SequenceSummary summary = sequence.summary();
    if (options.quiet && !options.json) return summary.same() ? exit_done : exit_different;
    if (is_sequence) {
        print_sequence(options, sequence.frames(), summary);
    } else {
        print_comparison(options, sequence.frames().front());
    }
    return summary.same() ? exit_done : exit_different;
}

}  // namespace aleph
