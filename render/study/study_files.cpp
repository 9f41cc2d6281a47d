// The results of a study as JSON and as comma-separated values.

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "render/settings/fingerprint.h"
#include "render/study/effects_ledger.h"
#include "render/study/search_study.h"
#include "render/study/study_files.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json values_json(const std::map<std::string, MeasuredValue>& values, const std::vector<Metric>& metrics) {
    Json json = Json::object();
    for (const Metric& metric : metrics) {
        const auto found = values.find(metric.name);
        if (found == values.end()) continue;
        json[metric.name] = {{"value", found->second.value},
                             {"error", found->second.error ? Json(*found->second.error) : Json()}};
    }
    return json;
}

Json settings_json(const SettingMap& settings) {
    Json json = Json::object();
    for (const auto& [key, value] : settings) json[key] = setting_json(value);
    return json;
}

Json parts_json(const std::vector<std::pair<std::string, double>>& parts, const char* name, const char* value) {
    Json json = Json::array();
    for (const auto& [part, amount] : parts) json.push_back({{name, part}, {value, amount}});
    return json;
}

Json variant_json(const VariantResult& variant, const std::vector<Metric>& metrics, const fs::path& folder) {
    Json json{{"id", variant.name},
              {"settings", settings_json(variant.settings)},
              {"metrics", values_json(variant.metrics, metrics)},
              {"pareto", variant.on_front},
              {"frames", Json::array()}};
    for (const FrameResult& frame : variant.frames) {
        json["frames"].push_back({{"scene", frame.scene},
                                  {"frame", frame.frame},
                                  {"metrics", values_json(frame.metrics, metrics)},
                                  {"stages", parts_json(frame.stages, "stage", "seconds")},
                                  {"rays", parts_json(frame.rays, "kind", "count")},
                                  {"plan", Json::parse(frame.plan)},
                                  {"file", fs::path(frame.picture).lexically_proximate(folder).generic_string()}});
    }
    return json;
}

/// "model name" of /proc/cpuinfo, where there is one.
std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "not known";
}

Json host_json(int threads) {
    char name[256] = "";
    if (gethostname(name, sizeof name - 1) != 0) name[0] = 0;
    const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    return {{"name", name},
            {"processor", processor_name()},
            {"threads", threads},
            {"memory_mib", std::round(memory / (1 << 20))}};
}

/// @param metric  whose axis is better logarithmic: all but the bias, which has a sign
Json metric_json(const Metric& metric) {
    return {{"name", metric.name},
            {"title", metric.title},
            {"unit", metric.unit},
            {"log", metric.name != "bias"},
            {"cost", metric.cost}};
}

Json frames_json(const StudyResults& results, const fs::path& folder) {
    Json json = Json::array();
    for (const JudgingFrame& frame : results.frames) {
        json.push_back({{"scene", frame.scene},
                        {"frame", frame.frame},
                        {"reference", frame.reference.lexically_proximate(folder).generic_string()},
                        {"reference_share_beyond_by_noise", frame.quality.share_by_noise},
                        {"reference_noise_p99", frame.quality.percentile_99}});
    }
    return json;
}

Json axes_json(const std::vector<StudyAxis>& axes) {
    Json json = Json::array();
    for (const StudyAxis& axis : axes) {
        Json values = Json::array();
        for (const SettingValue& value : axis.values) values.push_back(setting_json(value));
        json.push_back({{"setting", axis.setting}, {"values", values}});
    }
    return json;
}

Json point_json(const SearchedPoint& point) {
    return {{"variant", point.variant}, {"processor_seconds", point.point.cost}, {"share_seen", point.point.error}};
}

/// The rounds of a search and its results, scene by scene: the front of fixed settings, and what they take to show
/// as little as each variant of the study.
Json search_json(const PreparedStudy& prepared, const StudyResults& results) {
    constexpr const char* bounds[] = {"exact", "at most", "more than"};
    Json json{{"candidates", prepared.candidates.size()}, {"scenes", Json::array()}};
    const std::vector<SceneSearch> summaries = summarize_search(prepared, results);
    for (std::size_t s = 0; s < summaries.size(); ++s) {
        Json& scene = json["scenes"].emplace_back();
        scene = {{"scene", summaries[s].scene},
                 {"rounds", Json::array()},
                 {"front", Json::array()},
                 {"against", Json::array()}};
        for (const SearchRound& round : rounds_of(prepared, prepared.scenes[s])) {
            scene["rounds"].push_back({{"candidates", round.candidates},
                                       {"size", fmt::format("{}x{}", round.width, round.height)},
                                       {"frames", round.frames}});
        }
        for (const SearchedPoint& point : summaries[s].front) scene["front"].push_back(point_json(point));
        for (const AgainstFixed& against : summaries[s].against) {
            Json entry = point_json(against.own);
            entry["fixed_seconds"] = against.fixed.cost;
            entry["fixed_seconds_are"] = bounds[static_cast<int>(against.fixed.bound)];
            scene["against"].push_back(std::move(entry));
        }
    }
    return json;
}

std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

std::string study_date() {
    std::time_t now = std::time(nullptr);
    if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) now = std::strtoll(epoch, nullptr, 10);
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

std::string brief(double value, int digits) {
    const double size = std::abs(value);
    return size >= std::pow(10.0, digits) - 0.5 && size < 1e9 ? fmt::format("{:.0f}", value)
                                                              : fmt::format("{:.{}g}", value, digits);
}

std::string describe_reference(const PreparedStudy& prepared, const StudyResults& results) {
    const StudyReference& reference = prepared.study.reference;
    const std::string kind =
        reference.kind == "path" ? "traced paths" : "given settings: " + name_settings(reference.settings);
    double share = 0.0, noise = 0.0;
    for (const JudgingFrame& frame : results.frames) {
        share = std::max(share, frame.quality.share_by_noise);
        noise = std::max(noise, frame.quality.percentile_99);
    }
    return fmt::format(
        "{}; mean of {} renderings with random numbers of their own; its standard error is {} visible thresholds "
        "in the 99th percentile of the pixels, which alone puts {} % of them beyond one threshold",
        kind, reference.passes, brief(noise, 2), brief(share, 2));
}

Json study_json(const PreparedStudy& prepared, const StudyResults& results, const StudyContext& context) {
    const Study& study = prepared.study;
    Json json{{"schema_version", 1},
              {"title", study.title},
              {"description", study.description},
              {"command", context.command},
              {"date", context.date},
              {"host", host_json(context.threads)},
              {"build", {{"version", ALEPH_VERSION}, {"program", program_build()}, {"compiler", __VERSION__}}},
              {"settings", settings_json(study.settings)}};
    for (const PreparedStudyScene& scene : prepared.scenes) json["scenes"].push_back(scene.scene.source.file);
    const RenderSettings base = with_settings_of(prepared.scenes.front(), study, {}).settings;
    json["width"] = base.picture.width;
    json["height"] = base.picture.height;
    json["frames"] = frames_json(results, context.folder);
    json["reference"] = {{"kind", study.reference.kind},
                         {"passes", study.reference.passes},
                         {"spp", study.reference.spp},
                         {"note", describe_reference(prepared, results)}};
    for (const StudyViewer& viewer : study.viewers)
        json["viewers"].push_back({{"name", viewer.name}, {"settings", settings_json(viewer.settings)}});
    json["repeats"] = study.runs.repeats;
    json["seeds"] = study.runs.seeds;
    json["axes"] = axes_json(study.sweep);
    if (study.search) {
        json["search"] = search_json(prepared, results);
        json["search"]["axes"] = axes_json(study.search->settings);
    }
    if (study.effects) json["ledger"] = to_json(make_ledger(prepared, results));
    json["metrics"] = Json::array();
    for (const Metric& metric : prepared.metrics) json["metrics"].push_back(metric_json(metric));
    json["variants"] = Json::array();
    for (const VariantResult& variant : results.variants)
        json["variants"].push_back(variant_json(variant, prepared.metrics, context.folder));
    return json;
}

std::string study_csv(const PreparedStudy& prepared, const StudyResults& results) {
    std::set<std::string> settings;
    for (const VariantResult& variant : results.variants) {
        for (const auto& [key, value] : variant.settings) settings.insert(key);
    }
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
                const bool known = found != frame.metrics.end();
                text += known ? fmt::format(",{},", found->second.value) : ",,";
                if (known && found->second.error) text += fmt::format("{}", *found->second.error);
            }
            text += "\n";
        }
    }
    return text;
}

}  // namespace aleph
