#pragma once
// The parts of a .glb that write_glb puts together: glb_materials.cpp makes the images, textures and materials,
// glb_writer.cpp all else.

#include <tiny_gltf.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

namespace gltf = tinygltf;

[[noreturn]] inline void refuse(const std::string& what) {
    throw std::runtime_error("this writer does not write " + what);
}

inline std::vector<double> numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
inline std::vector<double> numbers(const glm::dquat& q) {
    return {q.x, q.y, q.z, q.w};
}

template <class T>
const T& constant(const Track<T>& track, const char* what) {
    if (track.key_count() != 1) refuse(std::string("animated ") + what);
    return key_value(track, 0);
}

class GlbWriter {
  public:
    explicit GlbWriter(const Scene& scene) : scene_(scene) { model_.buffers.emplace_back(); }

    gltf::Model write();

  private:
    int add_view(const void* data, std::size_t size, int target = 0);
    int add_floats(const std::vector<float>& values, int type, std::size_t components, bool with_bounds);
    template <class V>
    int add_vectors(const std::vector<V>& vectors, int type, bool with_bounds = false);
    void add_images();
    int texture_of(const TextureRef& reference);
    gltf::Value texture_info(const TextureRef& reference, double scale = 1.0);
    void add_texture(gltf::Value::Object& members, const char* key, const TextureRef& reference, double scale = 1.0);
    void extend(gltf::Material& material, const char* name, gltf::Value::Object members);
    void add_volume(const Material& source, gltf::Material& material);
    void add_clearcoat(const Material& source, gltf::Material& material);
    void add_sheen(const Material& source, gltf::Material& material);
    void add_anisotropy(const Material& source, gltf::Material& material);
    void add_material(const Material& material);
    gltf::Primitive make_primitive(const Mesh& mesh);
    void add_camera(const Camera& camera);
    void add_light(const Light& light);
    void add_node(const Node& node);
    template <class T>
    void animate(int node, const char* path, const Track<T>& track);
    void use(const char* extension) {
        for (const std::string& used : model_.extensionsUsed) {
            if (used == extension) return;
        }
        model_.extensionsUsed.emplace_back(extension);
    }

    const Scene& scene_;
    gltf::Model model_;
};

}  // namespace aleph
