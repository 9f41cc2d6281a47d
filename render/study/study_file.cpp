// Study files, and which variants a study has.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/json/json_ref.h"
#include "engine/json/schema.h"
#include "engine/json/text.h"
#include "render/settings/frame_list.h"
#include "render/settings/frame_pattern.h"
#include "render/settings/settings.h"
#include "render/study/search_study.h"

namespace aleph {

namespace {

constexpr const char* schema_text =
#include "study_schema.inc"
    ;

SettingValue read_value(const nlohmann::json& value) {
    if (value.is_boolean()) return value.get<bool>();
    if (value.is_number()) return value.get<double>();
    return value.get<std::string>();
}

SettingMap find_settings(const JsonRef& parent) {
    SettingMap settings;
    if (const auto found = parent.find("settings")) {
        for (const auto& [key, value] : found->json().items()) settings[key] = read_value(value);
    }
    return settings;
}

StudyReference read_reference(const JsonRef& root) {
    StudyReference reference;
    const auto found = root.find("reference");
    if (!found) return reference;
    reference.kind = found->json().value("kind", reference.kind);
    reference.passes = found->json().value("passes", reference.passes);
    reference.spp = found->json().value("spp", reference.spp);
    reference.settings = find_settings(*found);
    if (reference.kind != "settings" && !reference.settings.empty())
        found->fail("only a reference of the kind \"settings\" has settings");
    return reference;
}

StudyAxis read_axis(const std::string& setting, const nlohmann::json& values) {
    StudyAxis axis{setting, {}};
    for (const nlohmann::json& value : values) axis.values.push_back(read_value(value));
    return axis;
}

/// Settings that the file names take its values; others have those of the default. The schema has checked the ranges.
std::optional<StudySearch> read_search(const JsonRef& root) {
    const auto found = root.find("search");
    if (!found) return std::nullopt;
    StudySearch search = default_search();
    search.candidates = found->json().value("candidates", search.candidates);
    search.rounds = found->json().value("rounds", search.rounds);
    const auto settings = found->find("settings");
    if (!settings) return search;
    const auto refuse = [&](const char* key, const char* reason) {
        if (const auto wrong = settings->find(key)) wrong->fail(reason);
    };
    refuse("error", "a search tries fixed settings: no error is asked for");
    refuse("sampling", "a search tries fixed settings: sampling is uniform");
    refuse("size", "pictures of a study have one size: `size` of the study");
    refuse("seed", "the seeds of a study are its list `seeds`");
    for (const auto& [key, values] : settings->json().items()) {
        std::erase_if(search.settings, [&](const StudyAxis& axis) { return axis.setting == key; });
        search.settings.push_back(read_axis(key, values));
    }
    return search;
}

/// The files by frame that a pattern such as name.####.exr names.
std::map<std::int64_t, std::filesystem::path> find_pictures(const JsonRef& at, const std::filesystem::path& folder) {
    try {
        return find_frame_files((folder / at.string()).string());
    } catch (const InputError& error) {
        at.fail(error.reason());
    }
}

/// The text of a list of frames; empty without one.
std::string read_frames(const JsonRef& scene) {
    const auto frames = scene.find("frames");
    if (!frames || frames->string().empty()) return {};
    try {
        parse_frame_list(frames->string());
    } catch (const InputError& error) {
        frames->fail(error.reason());
    }
    return frames->string();
}

void read_lists(const JsonRef& root, const std::filesystem::path& folder, Study& study) {
    for_each_object(root, "scenes", [&](const JsonRef& scene, std::size_t) {
        const std::filesystem::path file = scene.require("scene").string();
        study.scenes.push_back({file.is_absolute() ? file : (folder / file).lexically_normal(), read_frames(scene)});
    });
    for_each_object(root, "variants", [&](const JsonRef& variant, std::size_t) {
        SettingMap settings = find_settings(variant);
        std::string name = variant.find_string("name").value_or(name_settings(settings));
        if (name.empty()) variant.fail("a variant without settings needs a name");
        const auto pictures = variant.find("pictures");
        if (pictures && !settings.empty()) pictures->fail("pictures that are there have no settings");
        if (!pictures && !variant.find("settings")) variant.fail("a variant has settings or pictures");
        study.variants.push_back({std::move(name), std::move(settings)});
        if (pictures) study.variants.back().pictures = find_pictures(*pictures, folder);
    });
    for_each_object(root, "viewers", [&](const JsonRef& viewer, std::size_t) {
        study.viewers.push_back({viewer.require("name").string(), find_settings(viewer)});
    });
}

}  // namespace

bool is_study(const std::filesystem::path& file) {
    if (file.extension() != ".json") return false;
    const nlohmann::json root = parse_json_text(read_text(file), file.string()).root;
    return root.is_object() && root.contains("scenes");
}

Study parse_study(std::string_view text, const std::filesystem::path& path) {
    static const JsonSchema schema(nlohmann::json::parse(schema_text));
    const std::string file = path.string();
    const JsonText json = parse_json_text(text, file);
    if (const auto mismatch = schema.find_mismatch(json.root))
        throw InputError(file, mismatch->pointer, mismatch->reason);
    const JsonRef root(json.root, file);
    Study study;
    study.file = file;
    study.title = root.find_string("title").value_or(path.stem().string());
    study.description = root.find_string("description").value_or("");
    study.settings = find_settings(root);
    study.settings["size"] = root.find_string("size").value_or("320x240");
    study.reference = read_reference(root);
    if (const auto order = json.key_order.find("sweep"); order != json.key_order.end()) {
        for (const std::string& key : order->second)
            study.sweep.push_back(read_axis(key, json.root.at("sweep").at(key)));
    }
    read_lists(root, path.parent_path(), study);
    study.effects = json.root.value("effects", false);
    study.search = read_search(root);
    study.metrics = json.root.value("metrics", study.metrics);
    if (study.viewers.empty()) study.viewers.emplace_back();
    study.runs.repeats = json.root.value("repeats", study.runs.repeats);
    study.runs.seeds = json.root.value("seeds", study.runs.seeds);
    return study;
}

Study load_study(const std::filesystem::path& file) {
    return parse_study(read_text(file), file);
}

std::vector<SettingMap> list_combinations(const std::vector<StudyAxis>& axes) {
    constexpr std::size_t most = 10000;
    std::vector<SettingMap> all(1);
    for (const StudyAxis& axis : axes) {
        std::vector<SettingMap> longer;
        for (SettingMap& settings : all) {
            for (const SettingValue& value : axis.values) {
                if (longer.size() == most) throw InputError("", "sweep", fmt::format("more than {} variants", most));
                settings[axis.setting] = value;
                longer.push_back(settings);
            }
        }
        all = std::move(longer);
    }
    return all;
}

std::string name_settings(const SettingMap& settings, const std::vector<StudyAxis>& order) {
    std::string name;
    const auto add = [&](const std::string& key, const SettingValue& value) {
        name += fmt::format("{}{}={}", name.empty() ? "" : ",", key, setting_text(value));
    };
    std::set<std::string> done;
    for (const StudyAxis& axis : order) {
        const auto found = settings.find(axis.setting);
        if (found != settings.end() && done.insert(axis.setting).second) add(axis.setting, found->second);
    }
    for (const auto& [key, value] : settings) {
        if (!done.contains(key)) add(key, value);
    }
    return name;
}

std::vector<StudyVariant> list_variants(const Study& study) {
    std::vector<StudyVariant> variants;
    if (!study.sweep.empty()) {
        for (const SettingMap& settings : list_combinations(study.sweep))
            variants.push_back({name_settings(settings, study.sweep), settings});
    }
    std::ranges::copy(study.variants, std::back_inserter(variants));
    if (variants.empty() && !study.search) throw InputError("", "sweep", "the study has no variants");
    std::set<std::string> names;
    for (const StudyVariant& variant : variants) {
        if (!names.insert(variant.name).second)
            throw InputError("", variant.name, "two variants of the study have this name");
    }
    return variants;
}

}  // namespace aleph
