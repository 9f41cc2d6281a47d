#pragma once
// Checks, warnings and defaults of a complete scene, whatever file it came from.

#include "engine/scene/scene.h"

namespace aleph {

/// The path of the file that brought an element: of the include, or of the scene itself for no_index.
std::string source_file(const Scene& scene, int include);

/// At the first, the middle and the last frame:
/// - refuses a camera whose node and parents scale two or all axes to 0: it has no axes left;
/// - warns of nodes with meshes whose transform flattens them, or shrinks them to a point: rays leave out what has no
///   volume (RayScene::update).
/// A scale that is 0 only for a while is fine, and a common way to hide an object.
/// @throws InputError naming the file that brought the camera, and its node
void check_scales(Scene& scene);

/// Warns of rotation keys that are more than 170 degrees apart, as interpolation takes the short way and the other may
/// be meant, and of rotations whose length is off by more than 1e-3 (they count at length 1). Nodes, and the
/// environment's picture.
void add_rotation_warnings(Scene& scene);

/// Adds at most one warning of each kind, with the name of the first mesh and how many more there are:
/// - rigid meshes whose triangles all have no area (corners that coincide or lie on a line);
/// - meshes with a texture for which they have no texture coordinates, one warning for each material;
/// - meshes with a normal map or anisotropy and no texture coordinates to give directions, one for each material;
/// - texture coordinates beyond 1e6, where single precision holds no place within a texture.
/// Meshes that no node uses do not count.
void add_mesh_warnings(Scene& scene);

/// Warns of fields of view, rotations and cones of spots of the scene file that look like radians.
void add_radian_warnings(Scene& scene);

/// Warns of nodes of the scene file with keys that all lie before the frame range, or after it.
void add_key_warnings(Scene& scene);

/// Warns of cuts outside the frame range, and of cameras that jump by step keys where there is no cut.
void add_cut_warnings(Scene& scene);

/// True where surfaces of the material give light at some time.
bool gives_light(const Material& material);

/// True if something gives light at some time: a light on a node, an environment, a used material that emits.
bool has_light(const Scene& scene);

/// Gives a scene without light a constant white environment and a warning.
void add_missing_light(Scene& scene);

/// Adds a camera on a node of its own, and a warning. The camera sees everything that is visible at up to 16 frames of
/// the scene's range, from the +z side and a little above, with a field of view of 45 degrees. Camera and node become
/// the first of their lists, as elements of the scene come before those of includes: other indices grow by one.
void add_framing_camera(Scene& scene);

}  // namespace aleph
