// The --stats file: counts and times of every frame as JSON.

#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "engine/base/parallel.h"
#include "render/guide/error_report.h"
#include "render/output/frame_files.h"
#include "render/plan/effect_table.h"
#include "render/settings/setting_table.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

Json keyframes_json(const std::vector<KeyframeStatistics>& keyframes) {
    Json list = Json::array();
    for (const KeyframeStatistics& m : keyframes) {
        list.push_back({{"frame", m.frame},
                        {"records", m.counts.records},
                        {"multi_bounce_records", m.counts.multi_bounce_records},
                        {"multi_bounce_rays", m.counts.multi_bounce_rays},
                        {"rays",
                         {{"primary", m.counts.rays.primary},
                          {"shadow", m.counts.rays.shadow},
                          {"gather", m.counts.rays.gather},
                          {"total", m.counts.rays.total()}}},
                        {"seconds", m.seconds}});
    }
    return list;
}

Json error_json(const std::optional<ErrorShares>& error) {
    if (!error) return nullptr;
    Json causes = Json::object();
    for (std::size_t i = 0; i < cause_count; ++i) causes[cause_names()[i]] = error->by_cause[i];
    return {{"asked", error->asked}, {"share_beyond", error->beyond}, {"by_cause", causes}};
}

/// Whole numbers without a decimal point.
Json exact_setting(const Setting& setting, const RenderSettings& settings) {
    const SettingValue value = setting.get(settings);
    if (setting.type == SettingType::whole_number) return static_cast<std::int64_t>(std::get<double>(value));
    return setting_json(value);
}

Json budget_json(const BudgetStatistics& budget) {
    return {{"asked", budget.asked},
            {"error", budget.error},
            {"predicted", budget.predicted},
            {"took", budget.took > 0.0 ? Json(budget.took) : Json(nullptr)},
            {"pilot", budget.pilot}};
}

Json share_json(const VerifiedShare& share) {
    return {{"share", share.share}, {"low", share.low}, {"high", share.high}};
}

Json verified_json(const VerifiedStatistics& verified) {
    return {{"error", verified.error},
            {"beyond", share_json(verified.beyond)},
            {"seen", share_json(verified.seen)},
            {"flicker", share_json(verified.flicker)},
            {"lasting", share_json(verified.lasting)},
            {"estimated_beyond", verified.estimated ? Json(*verified.estimated) : Json(nullptr)},
            {"blocks", verified.blocks},
            {"frames", verified.frames},
            {"window", verified.window},
            {"unsettled", verified.unsettled},
            {"seconds", verified.seconds}};
}

/// As `--crop` has it.
Json window_json(const std::optional<PictureArea>& window) {
    if (!window) return nullptr;
    return {window->x, window->x + window->width, window->y, window->y + window->height};
}

Json frame_json(const FrameStatistics& f) {
    Json seconds = Json::object();
    for (const auto& [stage, value] : list_stages(f.seconds)) seconds[stage] = value;
    return {{"frame", f.frame},
            {"copy_of", f.copy_of ? Json(*f.copy_of) : Json(nullptr)},
            {"window", window_json(f.window)},
            {"seconds", seconds},
            {"rays",
             {{"primary", f.counts.rays.primary},
              {"shadow", f.counts.rays.shadow},
              {"gather", f.counts.rays.gather},
              {"glossy", f.counts.rays.glossy},
              {"specular", f.counts.rays.specular},
              {"path", f.counts.rays.path},
              {"multi_bounce", f.counts.rays.multi_bounce},
              {"total", f.counts.rays.total()},
              {"traced", f.traced.all},
              {"invalid", f.traced.invalid}}},
            {"cache",
             {{"records", f.counts.records},
              {"multi_bounce_records", f.counts.multi_bounce_records},
              {"multi_bounce_rays", f.counts.multi_bounce_rays},
              {"lookups", f.counts.cache.lookups},
              {"hits", f.counts.cache.hits},
              {"rounds", f.counts.cache.rounds}}},
            {"keyframes", keyframes_json(f.keyframes)},
            {"samples", f.counts.samples},
            {"error", error_json(f.error)},
            {"nan", f.counts.invalid_samples},
            {"estimate",
             {{"replaced", f.estimate.sanitized.replaced},
              {"clamped", f.estimate.sanitized.clamped},
              {"median_cd_m2", f.estimate.median_luminance}}},
            {"saliency_fallback", f.estimate.saliency_fallback},
            {"plan", to_json(f.plan)},
            {"plan_seconds", f.seconds.plan},
            {"instances_updated", f.instances_touched},
            {"peak_memory_mib", f.peak_memory_mib}};
}

}  // namespace

std::array<std::pair<const char*, double>, 10> list_stages(const StageSeconds& s) {
    return {{{"pose", s.pose},
             {"update", s.update},
             {"first_hits", s.first_hits},
             {"estimate", s.estimate},
             {"motion", s.motion},
             {"perception", s.perception},
             {"fill", s.fill},
             {"shade", s.shade},
             {"write", s.write},
             {"total", s.total}}};
}

std::string format_frame_statistics(const FrameStatistics& frame, const std::string& fingerprint) {
    Json json = frame_json(frame);
    if (!fingerprint.empty()) json["fingerprint"] = fingerprint;
    return indent_row(json.dump(2));
}

std::string indent_row(const std::string& json) {
    std::string indented = "    ";
    for (const char c : json) {
        indented += c;
        if (c == '\n') indented += "    ";
    }
    return indented;
}

std::string format_statistics(std::string_view frames, const Scene& scene, const RenderSettings& settings,
                              double exposure, const std::optional<BudgetStatistics>& budget,
                              const std::optional<VerifiedStatistics>& verified) {
    Json json;
    json["schema_version"] = 2;
    json["scene"] = scene.source.file;
    json["frames"] = Json::array();
    for (const Setting& setting : setting_table()) json["settings"][setting.key] = exact_setting(setting, settings);
    json["exposure"] = exposure;
    if (budget) json["budget"] = budget_json(*budget);
    if (verified) json["verified"] = verified_json(*verified);
    json["threads"] = thread_count();
    char host[256] = "";
    if (gethostname(host, sizeof host - 1) == 0) json["host"] = host;
    std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    if (frames.empty()) return text;
    const std::string_view empty = "\n  \"frames\": []";  // nowhere else: strings have neither quotes nor line ends
    return text.insert(text.find(empty) + empty.size() - 1, fmt::format("\n{}\n  ", frames));
}

}  // namespace aleph
