#include "render/cli/compare/compare_command.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"

namespace aleph {

namespace {

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

}  // namespace

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

}  // namespace aleph
