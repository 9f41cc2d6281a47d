#include "motion/object_motion.h"

#include <cmath>

namespace aleph {
namespace {

bool same_projection(const CameraView& a, const CameraView& b) {
    return a.width == b.width && a.height == b.height && a.orthographic == b.orthographic &&
           a.pixels_per_unit == b.pixels_per_unit && a.axis_offset == b.axis_offset;
}

}  // namespace

PreparedMotion prepare_motion(const Scene& scene, const PosedView& now, const PosedView& other, OtherFrame which,
                              const SeenInstances& seen) {
    PreparedMotion motion;
    motion.now = now.view;
    motion.other = other.view;
    motion.sign = displacement_sign(which);
    motion.diagonal = std::hypot(now.view.width, now.view.height);
    const bool same = same_projection(motion.now, motion.other);

    motion.background.counterpart = true;
    motion.background.now = make_background_map(motion.now, motion.now);
    motion.background.other = make_background_map(motion.now, motion.other);
    motion.background.still = motion.now.orthographic || (same && motion.background.now == motion.background.other);

    const std::vector<Instance>&instances = now.pose.instances, &other_instances = other.pose.instances;
    motion.objects.resize(seen.instances().size());
    for (std::size_t i = 0; i < motion.objects.size(); ++i) {
        const auto place = static_cast<std::size_t>(seen.instances()[i]);
        const Instance& instance = instances[place];
        ObjectMotion& object = motion.objects[i];
        object.mesh = &scene.meshes[instance.mesh];
        object.now = make_camera_from_object(motion.now, now.pose.world[instance.node]);
        // The list of instances is the same at every time; poses of different scenes have no counterparts.
        if (place >= other_instances.size() || !(other_instances[place] == instance)) continue;
        object.counterpart = other.pose.shown[place] != 0;
        object.other = make_camera_from_object(motion.other, other.pose.world[instance.node]);
        object.shape_now = &now.pose.meshes[instance.mesh];
        object.shape_other = &other.pose.meshes[instance.mesh];
        object.deforms = !object.shape_now->positions.empty();
        object.still = same && object.now == object.other && *object.shape_now == *object.shape_other;
    }
    return motion;
}

}  // namespace aleph
