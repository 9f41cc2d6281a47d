#pragma once
// The instances that an image of hits shows, numbered from 0, so that work per instance follows what is seen.

#include <vector>

#include "engine/base/image.h"
#include "engine/rays/ray_scene.h"

namespace aleph {

class SeenInstances {
  public:
    /// Numbers the instances in the order of their first pixels.
    /// @param instance_count  of the scene
    void find(const Image<Hit>& hits, std::size_t instance_count) {
        for (const int instance : instances_) numbers_[instance] = no_index;
        instances_.clear();
        numbers_.resize(instance_count, no_index);
        for (const Hit& hit : hits.pixels) {
            if (hit.instance == no_index || numbers_[hit.instance] != no_index) continue;
            numbers_[hit.instance] = static_cast<int>(instances_.size());
            instances_.push_back(hit.instance);
        }
    }

    const std::vector<int>& instances() const { return instances_; }
    /// Place of a seen instance in instances().
    int number(int instance) const { return numbers_[instance]; }

  private:
    std::vector<int> instances_;
    std::vector<int> numbers_;  ///< per instance; no_index: not seen
};

}  // namespace aleph
