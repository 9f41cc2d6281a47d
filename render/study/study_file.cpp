#include "render/study/study_file.h"

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/json/json_ref.h"
#include "engine/json/schema.h"
#include "engine/json/text.h"
#include "render/settings/frame_pattern.h"
#include "render/study/search_candidates.h"

namespace aleph {

namespace {

constexpr const char* schema_text =
#include "study_schema.inc"
    ;

std::string read_text(const std::filesystem::path& file) {
    const Bytes bytes = read_regular_file(file, file.string(), "");
    return {bytes.begin(), bytes.end()};
}

SettingValue read_value(const nlohmann::json& value) {
    if (value.is_boolean()) return value.get<bool>();
    if (value.is_number()) return value.get<double>();
    return value.get<std::string>();
}

SettingMap read_settings(const JsonRef& object) {
    SettingMap settings;
    for (const auto& [key, value] : object.json().items()) settings[key] = read_value(value);
    return settings;
}

SettingMap find_settings(const JsonRef& parent, std::string_view key) {
    const auto found = parent.find(key);
    return found ? read_settings(*found) : SettingMap();
}

StudyReference read_reference(const JsonRef& root) {
    StudyReference reference;
    const auto found = root.find("reference");
    if (!found) return reference;
    if (const auto kind = found->find_string("kind")) reference.kind = *kind;
    if (const auto passes = found->find_integer("passes", 2, 4096)) reference.passes = static_cast<int>(*passes);
    if (const auto spp = found->find_integer("spp", 1, 65536)) reference.spp = static_cast<int>(*spp);
    reference.settings = find_settings(*found, "settings");
    if (reference.kind != "settings" && !reference.settings.empty())
        found->fail("only a reference of the kind \"settings\" has settings");
    return reference;
}

StudyAxis read_axis(const std::string& setting, const nlohmann::json& values) {
    StudyAxis axis{setting, {}};
    for (const nlohmann::json& value : values) axis.values.push_back(read_value(value));
    return axis;
}

/// @param order  of the settings in the file
std::vector<StudyAxis> read_sweep(const JsonRef& root, const std::vector<std::string>& order) {
    std::vector<StudyAxis> sweep;
    const auto found = root.find("sweep");
    if (!found) return sweep;
    for (const std::string& key : order) sweep.push_back(read_axis(key, found->json().at(key)));
    return sweep;
}

/// Settings that the file names take its values; others have those of the default.
std::optional<StudySearch> read_search(const JsonRef& root) {
    const auto found = root.find("search");
    if (!found) return std::nullopt;
    StudySearch search = default_search();
    if (const auto candidates = found->find_integer("candidates", 1, 10000))
        search.candidates = static_cast<int>(*candidates);
    if (const auto rounds = found->find_integer("rounds", 1, 10)) search.rounds = static_cast<int>(*rounds);
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

std::vector<std::string> read_texts(const JsonRef& root, std::string_view key) {
    std::vector<std::string> texts;
    if (const auto found = root.find(key)) texts = found->json().get<std::vector<std::string>>();
    return texts;
}

/// The files by frame that a pattern such as name.####.exr names.
std::map<std::int64_t, std::filesystem::path> find_pictures(const JsonRef& at, const std::filesystem::path& folder) {
    try {
        return find_frame_files((folder / at.string()).string());
    } catch (const InputError& error) {
        at.fail(error.reason());
    }
}

/// Reads the lists of objects.
void read_lists(const JsonRef& root, const std::filesystem::path& folder, Study& study) {
    for_each_object(root, "scenes", [&](const JsonRef& scene, std::size_t) {
        const std::filesystem::path file = scene.require("scene").string();
        study.scenes.push_back(
            {file.is_absolute() ? file : (folder / file).lexically_normal(), scene.find_string("frames").value_or("")});
    });
    for_each_object(root, "variants", [&](const JsonRef& variant, std::size_t) {
        SettingMap settings = find_settings(variant, "settings");
        std::string name = variant.find_string("name").value_or(name_settings(settings));
        if (name.empty()) variant.fail("a variant without settings needs a name");
        const auto pictures = variant.find("pictures");
        if (pictures && !settings.empty()) pictures->fail("pictures that are there have no settings");
        if (!pictures && !variant.find("settings")) variant.fail("a variant has settings or pictures");
        study.variants.push_back({std::move(name), std::move(settings)});
        if (pictures) study.variants.back().pictures = find_pictures(*pictures, folder);
    });
    for_each_object(root, "viewers", [&](const JsonRef& viewer, std::size_t) {
        study.viewers.push_back({viewer.require("name").string(), find_settings(viewer, "settings")});
    });
}

}  // namespace

StudyViewer default_viewer() {
    return {"own", {}};
}

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
    study.title = root.find_string("title").value_or(path.stem().string());
    study.description = root.find_string("description").value_or("");
    study.settings = find_settings(root, "settings");
    study.settings["size"] = root.find_string("size").value_or("320x240");
    study.reference = read_reference(root);
    const auto order = json.key_order.find("sweep");
    study.sweep = read_sweep(root, order == json.key_order.end() ? std::vector<std::string>() : order->second);
    read_lists(root, path.parent_path(), study);
    study.effects = root.has("effects") && root.require("effects").boolean();
    study.search = read_search(root);
    study.metrics = read_texts(root, "metrics");
    if (study.viewers.empty()) study.viewers.push_back(default_viewer());
    if (const auto repeats = root.find_integer("repeats", 1, 1000)) study.runs.repeats = static_cast<int>(*repeats);
    if (const auto seeds = root.find("seeds")) study.runs.seeds = seeds->json().get<std::vector<std::uint32_t>>();
    return study;
}

Study load_study(const std::filesystem::path& file) {
    return parse_study(read_text(file), file);
}

}  // namespace aleph
