#include "scenes/studies/study_frame.h"

#include "render/surface/texture.h"

namespace aleph {

StudyFrame::StudyFrame(const Sequence& sequence, const RenderSettings& settings, std::int64_t number)
    : scene(sequence.scene()),
      plan(make_pose_plan(scene)),
      camera(find_camera(scene, "")),
      frame(number),
      posed(make_posed_view(scene, scene.frame_rate.seconds_of(number), camera, settings.width, settings.height)),
      textures(make_texture_set(scene)),
      rays(scene, plan),
      shading(
          (rays.update(posed.pose, compute_anchor(posed.view)), make_shading_scene(scene, posed.pose, rays, textures))),
      lights(make_light_set(shading)),
      centers(cast_centers(rays, posed.view, nullptr)),
      exposure(sequence.exposure()) {}

void StudyFrame::move_to(std::int64_t number) {
    frame = number;
    update_posed_view(scene, plan, scene.frame_rate.seconds_of(number), camera, posed);
    rays.update_moving(posed.pose, compute_anchor(posed.view));
    update_shading_scene(shading, plan, rays);
    lights = make_light_set(shading);
    centers = cast_centers(rays, posed.view, nullptr);
}

Rgb reflect_unit_irradiance(const PixelSurface& surface) {
    const LitSurface lit(surface);
    return diffuse_radiance(surface.material, lit.cos_view, Rgb(1.0f)) * lit.below_sheen;
}

Sequence make_vision_sequence(const Scene& scene, RenderSettings settings, Guide guide, const VisionModel* vision) {
    settings.perception.guide = guide;
    settings.perception.vision = vision;
    return Sequence(scene, settings);
}

FrameVision compute_vision(Sequence& sequence, std::int64_t frame) {
    FrameRequest request;
    request.frame = false;
    request.maps = true;
    const double start = processor_seconds();
    FrameOutput out = sequence.render(frame, request);
    return {std::move(out.perception.aleph), std::move(out.threshold), std::move(out.tolerance),
            processor_seconds() - start};
}

}  // namespace aleph
