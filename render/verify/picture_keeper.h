#pragma once
// Pictures of frames that were rendered already, so that they need not be rendered again.

#include <cstdint>
#include <functional>
#include <list>
#include <utility>

#include "engine/base/color.h"
#include "engine/base/image.h"

namespace aleph {

class PictureKeeper {
  public:
    using Make = std::function<Image<Rgb>(std::int64_t frame)>;

    /// @param make  renders a frame that is not kept
    /// @param most  bytes that are kept; beyond them the pictures that were not used for longest are dropped
    PictureKeeper(Make make, std::size_t most) : make_(std::move(make)), most_(most) {}

    void keep(std::int64_t frame, Image<Rgb> picture);
    /// The picture of a frame, valid until the next call.
    const Image<Rgb>& find(std::int64_t frame);

  private:
    Make make_;
    std::size_t most_, bytes_ = 0;
    std::list<std::pair<std::int64_t, Image<Rgb>>> pictures_;  ///< used last first
};

}  // namespace aleph
