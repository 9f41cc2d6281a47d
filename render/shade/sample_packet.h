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
    /// @param known  the hit of its ray, until `finish`; null: not cast yet
    void add(const SamplePlace& place, int x, int y, const Hit* known) {
        const CameraRay ray = make_sample_ray(scene_.view, place, x, y);
        entries_[size_++] = {place, x, y, glm::vec3(ray.direction), known};
        if (known == nullptr) rays_[uncast_count_++] = to_scene(scene_.lighting.rays, ray);
    }

    /// Casts the rays, gives every sample to `shade(place, x, y, direction, hit)`, and empties the packet.
    template <class Shade>
    void finish(const Shade& shade) {
        std::array<Hit, capacity> hits;
        task_.tracer.intersect(std::span(rays_.data(), uncast_count_), std::span(hits.data(), uncast_count_));
        task_.counts.primary += uncast_count_;
        const Hit* next = hits.data();
        for (const Entry& e : std::span(entries_.data(), size_))
            shade(e.place, e.x, e.y, e.direction, e.known != nullptr ? *e.known : *next++);
        size_ = uncast_count_ = 0;
    }

  private:
    static constexpr std::size_t capacity = 16;

    struct Entry {
        SamplePlace place;
        int x = 0, y = 0;
        glm::vec3 direction{0.0f};
        const Hit* known = nullptr;
    };
    const SampleScene& scene_;
    ShadingTask& task_;
    std::size_t size_ = 0, uncast_count_ = 0;
    std::array<Entry, capacity> entries_;
    std::array<Ray, capacity> rays_;
};

}  // namespace aleph
