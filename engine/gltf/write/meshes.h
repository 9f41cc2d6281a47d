#pragma once
// glTF writer: meshes with their morph targets and joint weights.

#include <map>
#include <string>
#include <vector>

#include "engine/gltf/write/writer.h"
#include "engine/pose/deform.h"

namespace aleph {

/// Writes meshes that stand under one node as one glTF mesh, each a primitive.
class MeshWriter {
  public:
    explicit MeshWriter(GltfWriter& writer);

    /// Meshes of a node that may become one glTF mesh, in lists: those that do not deform, and those with the same skin
    /// and weights. Meshes that are not there at the same times stand apart, and those without triangles are left out.
    std::vector<std::vector<int>> group(const std::vector<int>& meshes) const;

    /// The glTF mesh of a group; the same for equal groups.
    /// @param name  of the node
    int write(const std::vector<int>& meshes, const std::string& name);

    /// Keys for the weights of a written mesh's targets, at each node that shows it; none where they do not change.
    const WrittenKeys& weight_keys(int mesh) const { return written_[mesh].weights; }

    /// Warns of normals that glTF does not allow.
    void finish();

  private:
    /// A scene mesh in the file.
    struct Written {
        OrderedJson primitive;
        std::vector<double> first_weights;  ///< of its targets
        WrittenKeys weights;
    };

    bool can_join(const Mesh& a, const Mesh& b) const;
    void write_primitive(int mesh);
    OrderedJson write_attributes(const Mesh& mesh, const std::vector<glm::vec3>& positions,
                                 const std::vector<glm::vec3>& normals);
    void write_targets(const Mesh& mesh, Written& written);
    void write_samples(int mesh, Written& written);
    OrderedJson write_target(const MorphTarget& target, std::size_t vertices, bool with_normals);
    void pose_sample(int mesh, double seconds);
    std::vector<glm::vec3> unit_normals(const Mesh& mesh, std::vector<glm::vec3> normals);

    GltfWriter& writer_;
    std::vector<Deformer> deformers_;
    std::vector<int> sampled_by_;  ///< per mesh: the deformer whose samples become targets, or no_index
    std::vector<Written> written_;
    std::map<std::vector<int>, int> groups_;
    std::size_t zero_normals_ = 0;
    std::string first_zero_normal_;
};

/// The numbers of vectors, one after the other. @param vectors  at least one
template <class V>
std::span<const float> floats_of(const std::vector<V>& vectors) {
    return {&vectors[0].x, vectors.size() * static_cast<std::size_t>(V::length())};
}

/// Adds JOINTS_n and WEIGHTS_n.
void write_joint_weights(GltfWriter& writer, const Mesh& mesh, OrderedJson& attributes);

}  // namespace aleph
