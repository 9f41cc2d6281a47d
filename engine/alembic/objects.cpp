// The tree of objects: one node each, instances expanded.

#include <fmt/format.h>

#include <algorithm>

#include "engine/alembic/reader.h"
#include "engine/base/errors.h"

namespace aleph {
namespace {

constexpr int max_instance_hops = 64;  // instances of instances of ...

const AlembicObject& object_at(const AlembicReader& reader, int index) {
    return reader.archive.objects()[index];
}

std::string read_source(const AlembicReader& reader, int instance) {
    return read_text(reader, reader.archive.properties(instance), ".instanceSource");
}

/// The object that an instance stands for, through instances of instances; of another object itself. @throws InputError
/// where there is none
int resolve_instance(const AlembicReader& reader, int instance) {
    int object = instance;
    for (int hop = 0; object_at(reader, object).is_instance(); ++hop) {
        const std::string source = read_source(reader, object);
        if (hop == max_instance_hops) reader.archive.fail(instance, "it is an instance of itself");
        object = find_object(reader, source);
        if (object < 0)
            reader.archive.fail(instance,
                                fmt::format("it is an instance of \"{}\", which is not there", printable(source)));
        if (object == instance) reader.archive.fail(instance, "it is an instance of itself");
    }
    return object;
}

class TreeReader {
  public:
    explicit TreeReader(AlembicReader& reader) : reader_(reader) {}

    /// @param name_of  whose name the node has: the object itself, or the instance that stands for it
    void read(int object, int name_of, int parent, std::size_t depth) {
        const AlembicObject& source = object_at(reader_, object);
        const std::string schema = source.schema();
        if (schema == "AbcGeom_FaceSet_v1" || schema == "AbcMaterial_Material_v1")
            return;  // read where surfaces name them
        if (depth > max_alembic_depth)
            reader_.archive.fail(name_of, fmt::format("instances are nested deeper than {}", max_alembic_depth));
        if (reader_.part.nodes.size() >= max_alembic_objects)
            reader_.archive.fail(name_of, fmt::format("instances make more than {} objects", max_alembic_objects));
        if (std::ranges::find(open_, object) != open_.end())
            reader_.archive.fail(name_of, "an instance contains itself");
        const int node = [&] {
            try {
                return add_node(object, name_of, parent, schema);
            } catch (const InputError& error) {  // names a byte or a property: the message also needs the object
                if (error.place().starts_with('/')) throw;
                reader_.archive.fail(object,
                                     error.place().empty() ? error.reason() : error.place() + ": " + error.reason());
            }
        }();
        open_.push_back(object);
        for (const int child : source.children) read(resolve_instance(reader_, child), child, node, depth + 1);
        open_.pop_back();
    }

  private:
    int add_node(int object, int name_of, int parent, const std::string& schema) {
        Node node{.name = object_at(reader_, name_of).name, .parent = parent};
        const AlembicCompound top = reader_.archive.properties(object);
        if (const AlembicProperty* visible = top.find_sampled("visible")) {
            // Node::visible: 0 hidden, 1 as the parent, 2 shown in any case.
            node.visible = read_whole_track(reader_, *visible, Interpolation::nearest, [](int v) {
                return v == 0 ? 0.0 : v < 0 ? 1.0 : 2.0;
            });
        }
        if (schema == "AbcGeom_Xform_v3") {
            read_transform(reader_, object, top, node);
        } else if (schema == "AbcGeom_PolyMesh_v1" || schema == "AbcGeom_SubD_v1") {
            node.meshes = meshes_of(object, top, schema);
        } else if (schema == "AbcGeom_Camera_v1") {
            node.camera = read_camera(reader_, object, top);
        } else if (!schema.empty()) {
            reader_.warn(object, fmt::format("objects of the kind {} are not read", printable(schema)));
        }
        const std::size_t channels = node.transform.operations ? node.transform.operations->channels.size() : 0;
        reader_.archive.budget().charge(1, sizeof(Node) + node.name.size() + sizeof(double) * channels);
        return append(reader_.part.nodes, std::move(node));
    }

    const std::vector<int>& meshes_of(int object, const AlembicCompound& top, const std::string& schema) {
        const auto known = reader_.meshes_of.find(object);
        if (known != reader_.meshes_of.end()) return known->second;
        const AlembicProperty* geom = top.find(".geom");
        if (geom == nullptr) return reader_.meshes_of[object];
        const auto read = schema == "AbcGeom_SubD_v1" ? read_subdivision : read_polygon_mesh;
        return reader_.meshes_of[object] = read(reader_, object, top, reader_.archive.properties(*geom));
    }

    AlembicReader& reader_;
    std::vector<int> open_;  ///< objects that are being read, outermost first
};

/// @param hops  instances that may still be passed on the way, all detours included
int find_object(const AlembicReader& reader, const std::string& path, int& hops) {
    int object = 0;
    std::size_t position = 0;
    if (path.empty() || path.front() != '/') return -1;
    while (position < path.size()) {
        const std::size_t begin = position + 1;
        position = std::min(path.find('/', begin), path.size());
        if (position == begin) continue;
        while (object_at(reader, object).is_instance()) {
            if (hops-- <= 0) return -1;
            object = find_object(reader, read_source(reader, object), hops);
            if (object < 0) return -1;
        }
        const std::string_view name = std::string_view(path).substr(begin, position - begin);
        const auto found = reader.child_of.find({object, name});
        if (found == reader.child_of.end()) return -1;
        object = found->second;
    }
    return object;
}

}  // namespace

int find_object(const AlembicReader& reader, const std::string& path) {
    int hops = max_instance_hops;
    return find_object(reader, path, hops);
}

std::string read_text(const AlembicReader& reader, const AlembicCompound& compound, std::string_view name) {
    const AlembicProperty* property = compound.find_sampled(name);
    if (property == nullptr) return {};
    const std::vector<std::string> texts = reader.archive.texts(*property, 0);
    return texts.empty() ? std::string() : texts.front();
}

void read_objects(AlembicReader& reader) {
    TreeReader tree(reader);
    for (const int child : object_at(reader, 0).children)
        tree.read(resolve_instance(reader, child), child, no_index, 1);
}

}  // namespace aleph
