#pragma once
// The parts of the scene `art-gallery`. Metres; the floor is y = 0; the hall is along x, the cabinet behind its far
// wall.

#include <vector>

#include "engine/scene/scene.h"
#include "scenes/common/generator.h"

namespace aleph {

inline constexpr int gallery_last_frame = 749;  ///< the first is 0; 30 frames per second
inline constexpr double gallery_seconds = 749.0 / 30.0;

/// Inner faces of the hall and of the cabinet.
inline constexpr glm::dvec3 hall_low{-6.0, 0.0, -3.8}, hall_high{6.0, 4.2, 3.8};
inline constexpr glm::dvec3 cabinet_low{-10.2, 0.0, -2.6}, cabinet_high{-6.25, 3.6, 2.6};
inline constexpr double door_half_width = 1.1, door_height = 2.9;

/// @param textures  folder of the textures, relative to the scene file
Scene make_art_gallery(const std::string& textures);

inline constexpr double gravity = 9.81;  ///< m/s2

struct BallDrop {
    double release = 0.0;         ///< s; the ball is at rest before
    glm::dvec3 position{0.0};     ///< m, of the centre at release
    glm::dvec3 velocity{0.0};     ///< m/s, at release
    double radius = 0.1;          ///< m
    double ground = 0.0;          ///< m, height of the ground
    double restitution = 0.8;     ///< vertical speed after an impact over that before
    double grip = 1.0;            ///< horizontal speed after an impact over that before
    double rolling = 0.08;        ///< m/s2, deceleration of a rolling ball
    double settled_speed = 0.12;  ///< m/s; slower impacts end the bouncing
};

/// The balls under the ring, then the two that roll off their plinths.
std::vector<BallDrop> make_ball_drops();

/// Materials shared by several parts.
struct GalleryMaterials {
    int wall, blue_wall, ceiling, parquet, trim, plinth, marble, oak, dark, steel, gilt, black_frame, white_frame;
};

void add_rooms(Scene& scene, const GalleryMaterials& materials);
void add_lamps(Scene& scene, const GalleryMaterials& materials);
void add_pictures(Scene& scene, const GalleryMaterials& materials);
void add_furniture(Scene& scene, const GalleryMaterials& materials);
void add_sculptures(Scene& scene, const GalleryMaterials& materials);
void add_ball_work(Scene& scene, const GalleryMaterials& materials);
void add_top(Scene& scene, const GalleryMaterials& materials);
void add_kinetic_work(Scene& scene, const GalleryMaterials& materials);
void add_mobile(Scene& scene, const GalleryMaterials& materials);
void add_gallery_camera(Scene& scene);

// Drawn from formulas, deterministic.
/// Fourteen paintings, with the aspect ratios of their frames.
std::vector<DrawnTexture> make_painted_pictures();   ///< strokes and marks on a ground
std::vector<DrawnTexture> make_computed_pictures();  ///< a colour for every point

/// "parquet", "marble", "oak", "weave", "terracotta", "top", "ball_0" to "ball_5": all repeat without a seam.
std::vector<DrawnTexture> make_gallery_surfaces();

/// All of these.
std::vector<DrawnTexture> make_gallery_textures();

}  // namespace aleph
