// Materials by name, from those shader parameters of an archive that Material has too.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include "engine/alembic/reader.h"
#include "engine/base/errors.h"

namespace aleph {
namespace {

constexpr const char* material_schema = "AbcMaterial_Material_v1";
constexpr double neutral_gray = 0.5;
constexpr double largest_number = 1e18;

using Values = std::vector<double>;

glm::dvec3 color_of(const Values& v) {
    return glm::clamp(v.size() >= 3 ? glm::dvec3(v[0], v[1], v[2]) : glm::dvec3(v[0]), 0.0, largest_number);
}

double share_of(const Values& v) {
    return std::clamp(v[0], 0.0, 1.0);
}

/// A property of Material, and the parameters that set it.
struct Meaning {
    std::vector<std::string_view> names;  ///< lower case, without "_"
    void (*set)(Material&, const Values&);
};

/// The base colour first.
const std::array<Meaning, 6>& meanings() {
    static const std::array<Meaning, 6> table{{
        {{"diffuse", "diffusecolor", "basecolor", "color", "albedo", "kdcolor"},
         [](Material& m, const Values& v) { m.base_color = glm::min(color_of(v), glm::dvec3(1.0)); }},
        {{"roughness", "specularroughness"}, [](Material& m, const Values& v) { m.gloss.roughness = share_of(v); }},
        {{"metallic", "metalness"}, [](Material& m, const Values& v) { m.gloss.metallic = share_of(v); }},
        {{"emissivecolor", "emission", "emissioncolor"},
         [](Material& m, const Values& v) { m.glow.color = color_of(v); }},
        {{"ior", "indexofrefraction", "specularior"},
         [](Material& m, const Values& v) {
             if (v[0] >= 1.0 && v[0] <= largest_number) m.gloss.ior = v[0];
         }},
        {{"specularlevel"}, [](Material& m, const Values& v) { m.gloss.specular = share_of(v); }},
    }};
    return table;
}

/// Null for a parameter that Material has not.
const Meaning* meaning_of(const std::string& name) {
    std::string plain;
    for (const char c : name)
        if (c != '_') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto knows = [&](const Meaning& meaning) {
        return std::ranges::find(meaning.names, plain) != meaning.names.end();
    };
    const auto found = std::ranges::find_if(meanings(), knows);
    return found == meanings().end() ? nullptr : &*found;
}

/// Values found for each meaning; the first ones are used.
using Found = std::map<const Meaning*, Values>;

void collect_parameters(AlembicReader& reader, int object, const AlembicCompound& parameters, Found& found) {
    for (const AlembicProperty& property : parameters.properties) {
        if (property.kind == AlembicProperty::Kind::compound || property.sample_count == 0) continue;
        const Meaning* const meaning = meaning_of(property.name);
        if (meaning == nullptr || !is_real(property.type) || found.contains(meaning)) continue;
        std::vector<double> values = reader.archive.numbers<double>(property, 0);
        const bool usable = !values.empty() && std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
        if (!usable) continue;
        if (!property.is_constant())
            reader.warn(object, "the material's parameters change over time; their first state is used");
        found.emplace(meaning, std::move(values));
    }
}

/// Parameters of the material's shaders and of the nodes of its network.
void collect_material(AlembicReader& reader, int object, Found& found) {
    const AlembicArchive& archive = reader.archive;
    for (const AlembicProperty& property : archive.properties(archive.properties(object), ".material").properties) {
        if (property.kind != AlembicProperty::Kind::compound) continue;
        const AlembicCompound content = archive.properties(property);
        if (property.name.ends_with(".params")) collect_parameters(reader, object, content, found);
        if (property.name != ".nodes") continue;
        for (const AlembicProperty& node : content.properties) {
            if (node.kind != AlembicProperty::Kind::compound) continue;
            const AlembicCompound network_node = archive.properties(node);
            const AlembicProperty* parameters = network_node.find("params");
            if (parameters != nullptr && parameters->kind == AlembicProperty::Kind::compound)
                collect_parameters(reader, object, archive.properties(*parameters), found);
        }
    }
}

Material make_neutral(const std::string& name) {
    return {.name = name, .base_color = glm::dvec3(neutral_gray)};
}

int add_material(AlembicReader& reader, const std::string& path, Material material) {
    return reader.material_of[path] = append(reader.part.materials, std::move(material));
}

}  // namespace

int neutral_material(AlembicReader& reader) {
    if (const auto known = reader.material_of.find(""); known != reader.material_of.end()) return known->second;
    return add_material(reader, "", make_neutral("neutral"));
}

int read_material(AlembicReader& reader, int object, const std::string& path) {
    if (const auto known = reader.material_of.find(path); known != reader.material_of.end()) return known->second;
    const std::string name = path.substr(path.rfind('/') + 1);
    Material material = make_neutral(name);
    const int source = find_object(reader, path);
    const auto is_material = [&](int index) {
        return index >= 0 && reader.archive.objects()[index].schema() == material_schema;
    };
    if (!is_material(source)) {
        reader.warn(object,
                    fmt::format("the archive has no material \"{}\"; a neutral one stands for it", printable(path)));
        return add_material(reader, path, std::move(material));
    }
    Found found;  // a material inherits what it does not set from the one above it
    for (int i = source; is_material(i); i = reader.archive.objects()[i].parent) collect_material(reader, i, found);
    for (const auto& [meaning, values] : found) meaning->set(material, values);
    if (!found.contains(&meanings().front()))
        reader.warn(source, "the material names no colour that is known here; it is a neutral gray");
    return add_material(reader, path, std::move(material));
}

}  // namespace aleph
