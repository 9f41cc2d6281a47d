#pragma once
// Changes to a scene that leave its pictures as they are, or change them in a known way.

#include "engine/scene/scene.h"

namespace aleph {

/// All lengths times `factor`, and the intensities of lamps that are points times its square.
void scale_lengths(Scene& scene, double factor);

/// All light times `factor`, and the exposure divided by it. The exposure must be set.
void scale_light(Scene& scene, double factor);

/// Everything happens `frames` frames later.
void delay(Scene& scene, std::int64_t frames);

/// Everything at t moves to -t. Steps are not turned round: they begin at their key.
void reverse_time(Scene& scene);

/// Everything below one new node, and the picture around the scene turned with it. It becomes node 0.
void place_below(Scene& scene, const glm::dvec3& translation, const glm::dquat& rotation);

/// Children and roots in the opposite order.
void reverse_nodes(Scene& scene);

void rename_everything(Scene& scene);

/// A material, a mesh, a lamp and a camera that no node uses, and a group without content.
void add_unused(Scene& scene);

/// Every mesh that does not deform becomes two with half of the triangles, under the same nodes.
void split_meshes(Scene& scene);

}  // namespace aleph
