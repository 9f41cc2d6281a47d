#pragma once
// The writer of scene files: state shared by its parts, and the parts. The reader: elements.cpp.

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "engine/base/errors.h"
#include "engine/scene/scene.h"

namespace aleph {

/// The scene and the writer's place in it.
struct SceneWriting {
    const Scene& scene;
    const std::string& file;
    std::string place;  ///< of the element that is written, for errors

    const FrameRate& rate() const { return scene.film.frame_rate; }
    [[noreturn]] void refuse(const std::string& reason) const { throw InputError(file, place, reason); }

    /// The name by which the element refers to another one.
    template <class List>
    const std::string& name_in(const List& list, int index, const char* what) const {
        if (index < 0 || index >= std::ssize(list))
            refuse(fmt::format("refers to {} {}, which belongs to an include or does not exist", what, index));
        return list[index].name;
    }

    /// Writes a track under a key unless it equals the value of an absent key.
    template <class T, class Write>
    void track(nlohmann::ordered_json& out, const char* key, const Track<T>& value, const Track<T>& absent,
               const Write& write) const {
        if (value == absent) return;
        validate(value, file, place + " " + key);
        out[key] = write(value, rate());
    }

    template <class Element, class Fields, class Write>
    void tracks(nlohmann::ordered_json& out, const Element& element, const Element& absent, const Fields& fields,
                const Write& write) const {
        for (const auto& field : fields) track(out, field.key, field.in(element), field.in(absent), write);
    }

    /// Writes numbers that do not change, unless they equal those of absent keys.
    template <class Element, class Fields>
    void fields(nlohmann::ordered_json& out, const Element& element, const Element& absent,
                const Fields& fields) const {
        for (const auto& field : fields)
            if (field.in(element) != field.in(absent)) out[field.key] = field.in(element);
    }

    /// Writes degrees where they give back every bit, else radians.
    void angle(nlohmann::ordered_json& out, const char* degrees_key, const char* radians_key,
               const Track<double>& value) const;
    template <class Element, class Fields>
    void angles(nlohmann::ordered_json& out, const Element& element, const Element& absent,
                const Fields& fields) const {
        for (const auto& field : fields) {
            if (field.in(element) != field.in(absent)) angle(out, field.key, field.key_in_radians, field.in(element));
        }
    }

    /// Writes the rotation about an axis where it is set, else the quaternion unless it is that of an absent key.
    void rotation(nlohmann::ordered_json& out, const char* key, const Track<glm::dquat>& value,
                  const std::optional<AxisRotation>& about_axis) const;
};

nlohmann::ordered_json write_material(const SceneWriting& at, const Material& material);
nlohmann::ordered_json write_light(const SceneWriting& at, const Light& light);
nlohmann::ordered_json write_camera(const SceneWriting& at, const Camera& camera);

// The reader: meshes.cpp and cages.cpp.

nlohmann::ordered_json write_points(const PointCache& cache, const FrameRate& rate);

/// The shape's parameters.
nlohmann::ordered_json write_shape(const Shape& shape);

/// @param points  name of the cage's points
nlohmann::ordered_json write_cage(const Cage& cage, const std::string& points);

/// Vertices and triangles as lists.
/// @param cache  its points over time; null if it has none
nlohmann::ordered_json write_triangles(const Mesh& mesh, const PointCache* cache, const FrameRate& rate);

}  // namespace aleph
