#pragma once
// Checks of a whole scene, for scenes that are made or changed in code. Readers check their files with messages of
// their own.

#include "engine/scene/scene.h"

namespace aleph {

/// Checks that every index names an element, that arrays which belong together have fitting sizes, and that every
/// number that a picture depends on is in the range that scene files allow (engine/scene_file/fields.h): keys, film,
/// points. Tangents may lead out of it between keys: `pose` clamps, and an eye that has no picture is refused there.
/// Textures' pixels, a mesh's normals, texture coordinates and colours may be any number.
/// @throws InputError: SceneSource::file, the element (`node 3 "ball"`), the reason
void validate(const Scene& scene);

/// A mesh of the scene: sizes and indices of its arrays, and its points.
/// @throws InputError
void validate_mesh(const Scene& scene, int mesh);

}  // namespace aleph
