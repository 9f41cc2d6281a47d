#pragma once
// A keyed track in one line, for tests.

#include <utility>
#include <vector>

#include "engine/scene/track.h"

namespace aleph {

/// Values at these times, s.
template <class T>
Track<T> keyed(std::vector<double> times, std::vector<T> values, Interpolation how = Interpolation::linear) {
    Track<T> track;
    track.sampling = {TimeSampling::Kind::acyclic, 0.0, 1.0, std::move(times)};
    track.interpolation = how;
    track.values = std::move(values);
    return track;
}

}  // namespace aleph
