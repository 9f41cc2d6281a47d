// The results of a study as comma-separated values.

#include <fmt/format.h>

#include <set>

#include "render/study/study_files.h"

namespace aleph {

namespace {

std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::set<std::string> list_settings(const StudyResults& results) {
    std::set<std::string> keys;
    for (const VariantResult& variant : results.variants) {
        for (const auto& [key, value] : variant.settings) keys.insert(key);
    }
    return keys;
}

}  // namespace

std::string study_csv(const PreparedStudy& prepared, const StudyResults& results) {
    const std::set<std::string> settings = list_settings(results);
    std::string text = "scene,frame,variant";
    for (const std::string& key : settings) text += "," + field(key);
    for (const Metric& metric : prepared.metrics) text += fmt::format(",{0},{0}_error", field(metric.name));
    text += "\n";
    for (const VariantResult& variant : results.variants) {
        for (const FrameResult& frame : variant.frames) {
            text += fmt::format("{},{},{}", field(frame.scene), frame.frame, field(variant.name));
            for (const std::string& key : settings) {
                const auto found = variant.settings.find(key);
                text += "," + (found == variant.settings.end() ? "" : field(setting_text(found->second)));
            }
            for (const Metric& metric : prepared.metrics) {
                const auto found = frame.metrics.find(metric.name);
                text += found == frame.metrics.end() ? std::string(",") : fmt::format(",{}", found->second.value);
                text += found == frame.metrics.end() || !found->second.error ? std::string(",")
                                                                             : fmt::format(",{}", *found->second.error);
            }
            text += "\n";
        }
    }
    return text;
}

}  // namespace aleph
