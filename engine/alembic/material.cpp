// Materials by name, from those shader parameters of an archive that Material has too.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include "engine/alembic/reader.h"
#include "engine/base/errors.h"

namespace aleph {
namespace {

constexpr const char* material_schema = "AbcMaterial_Material_v1";
constexpr double neutral_gray = 0.5;

enum class Meaning { base_color, roughness, metallic, emission, ior, specular };

struct KnownParameter {
    const char* name;  ///< lower case, without "_"
    Meaning meaning;
};

constexpr std::array known_parameters{
    KnownParameter{"diffuse", Meaning::base_color},     KnownParameter{"diffusecolor", Meaning::base_color},
    KnownParameter{"basecolor", Meaning::base_color},   KnownParameter{"color", Meaning::base_color},
    KnownParameter{"albedo", Meaning::base_color},      KnownParameter{"kdcolor", Meaning::base_color},
    KnownParameter{"roughness", Meaning::roughness},    KnownParameter{"specularroughness", Meaning::roughness},
    KnownParameter{"metallic", Meaning::metallic},      KnownParameter{"metalness", Meaning::metallic},
    KnownParameter{"emissivecolor", Meaning::emission}, KnownParameter{"emission", Meaning::emission},
    KnownParameter{"emissioncolor", Meaning::emission}, KnownParameter{"ior", Meaning::ior},
    KnownParameter{"indexofrefraction", Meaning::ior},  KnownParameter{"specularior", Meaning::ior},
    KnownParameter{"specularlevel", Meaning::specular},
};

std::optional<Meaning> meaning_of(const std::string& name) {
    std::string plain;
    for (const char c : name)
        if (c != '_') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const KnownParameter& known : known_parameters)
        if (plain == known.name) return known.meaning;
    return std::nullopt;
}

/// Values found for each meaning; the first ones are used.
using Found = std::map<Meaning, std::vector<double>>;

void collect_parameters(AlembicReader& reader, int object, const AlembicCompound& parameters, Found& found) {
    for (const AlembicProperty& property : parameters.properties) {
        if (property.kind == AlembicProperty::Kind::compound || property.sample_count == 0) continue;
        const std::optional<Meaning> meaning = meaning_of(property.name);
        if (!meaning || !is_real(property.type) || found.contains(*meaning)) continue;
        std::vector<double> values = reader.archive.numbers<double>(property, 0);
        const bool usable = !values.empty() && std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
        if (!usable) continue;
        if (!property.is_constant())
            reader.warn(object, "the material's parameters change over time; their first state is used");
        found.emplace(*meaning, std::move(values));
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

void set_parameters(const Found& found, Material& material) {
    const auto color = [](const std::vector<double>& values) {
        const glm::dvec3 rgb = values.size() >= 3 ? glm::dvec3(values[0], values[1], values[2]) : glm::dvec3(values[0]);
        return glm::max(rgb, glm::dvec3(0.0));
    };
    const auto share = [](const std::vector<double>& values) { return std::clamp(values[0], 0.0, 1.0); };
    for (const auto& [meaning, values] : found) {
        switch (meaning) {
            case Meaning::base_color:
                material.base_color = glm::min(color(values), glm::dvec3(1.0));
                break;
            case Meaning::roughness:
                material.gloss.roughness = share(values);
                break;
            case Meaning::metallic:
                material.gloss.metallic = share(values);
                break;
            case Meaning::emission:
                material.glow.color = color(values);
                break;
            case Meaning::ior:
                if (values[0] >= 1.0) material.gloss.ior = values[0];
                break;
            case Meaning::specular:
                material.gloss.specular = share(values);
                break;
        }
    }
}

int add_material(AlembicReader& reader, const std::string& path, Material material) {
    reader.part.materials.push_back(std::move(material));
    return reader.material_of[path] = static_cast<int>(reader.part.materials.size()) - 1;
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
    set_parameters(found, material);
    if (!found.contains(Meaning::base_color))
        reader.warn(source, "the material names no colour that is known here; it is a neutral gray");
    return add_material(reader, path, std::move(material));
}

}  // namespace aleph
