#pragma once
// Samples of neighbouring pixels whose rays are cast together.

#include <array>
#include <span>

#include "render/shade/sample_shading.h"

namespace aleph {

class SamplePacket {
  public:
    SamplePacket(const SampleScene& scene, ShadingTask& task) : scene_(scene), task_(task) {}

    bool is_full() const { return size_ == capacity; }
    /// @param known  the hit of its ray; null: not cast yet
    void add(const SamplePlace& place, int x, int y, const Hit* known) {
        const CameraRay ray = make_sample_ray(scene_.view, place, x, y);
        entries_[size_] = {place, x, y, glm::vec3(ray.direction), known == nullptr ? Hit{} : *known};
        if (known == nullptr) {
            uncast_[uncast_count_] = size_;
            rays_[uncast_count_++] = to_scene(scene_.lighting.rays, ray);
        }
        ++size_;
    }

    /// Casts the rays, gives every sample to `shade(place, x, y, direction, hit)`, and empties the packet.
    template <class Shade>
    void finish(const Shade& shade) {
        std::array<Hit, capacity> hits;
        task_.tracer.intersect(std::span(rays_.data(), uncast_count_), std::span(hits.data(), uncast_count_));
        task_.counts.primary += uncast_count_;
        for (std::size_t i = 0; i < uncast_count_; ++i) entries_[uncast_[i]].hit = hits[i];
        for (std::size_t i = 0; i < size_; ++i) {
            const Entry& e = entries_[i];
            shade(e.place, e.x, e.y, e.direction, e.hit);
        }
        size_ = uncast_count_ = 0;
    }

  private:
    static constexpr std::size_t capacity = 16;

    struct Entry {
        SamplePlace place;
        int x = 0, y = 0;
        glm::vec3 direction{0.0f};
        Hit hit;
    };
    const SampleScene& scene_;
    ShadingTask& task_;
    std::size_t size_ = 0, uncast_count_ = 0;
    std::array<Entry, capacity> entries_;
    std::array<Ray, capacity> rays_;
    std::array<std::size_t, capacity> uncast_;
};

}  // namespace aleph
