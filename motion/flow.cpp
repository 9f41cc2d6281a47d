#include "motion/flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "engine/base/errors.h"
#include "engine/base/opponent_color.h"
#include "engine/base/parallel.h"

#if defined(ALEPH_OPENCV)
#include <opencv2/video/tracking.hpp>
#endif

namespace aleph {

namespace {

[[noreturn]] void refuse_flow(const std::string& reason) {
    throw InputError("", "optical flow", reason);
}

#if defined(ALEPH_OPENCV)

constexpr int least_side = 32;  // pixels; smaller pictures are continued beyond their border

/// While it lives, OpenCV may choose nothing by processor or threads. Its switches hold for the whole program.
class PlainOpenCv {
  public:
    PlainOpenCv() : lock_(mutex()), threads_(cv::getNumThreads()), optimized_(cv::useOptimized()) {
        cv::setNumThreads(1);
        cv::setUseOptimized(false);
    }
    ~PlainOpenCv() {
        cv::setUseOptimized(optimized_);
        cv::setNumThreads(threads_);
    }

  private:
    static std::mutex& mutex() {
        static std::mutex one;
        return one;
    }
    std::lock_guard<std::mutex> lock_;
    int threads_;
    bool optimized_;
};

cv::Mat make_matrix(const Image<std::uint8_t>& picture) {
    cv::Mat matrix(std::max(picture.height, least_side), std::max(picture.width, least_side), CV_8UC1);
    for (int y = 0; y < matrix.rows; ++y) {
        const std::uint8_t* const from = picture.row(std::min(y, picture.height - 1));
        std::uint8_t* const to = matrix.ptr(y);
        std::copy_n(from, picture.width, to);
        std::fill(to + picture.width, to + matrix.cols, from[picture.width - 1]);
    }
    return matrix;
}

Image<glm::dvec2> search(const Image<std::uint8_t>& from, const Image<std::uint8_t>& to) {
    cv::Mat flow;
    cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM)->calc(make_matrix(from), make_matrix(to), flow);
    Image<glm::dvec2> displacement(from.width, from.height);
    for (int y = 0; y < from.height; ++y) {
        for (int x = 0; x < from.width; ++x) {
            const auto& way = flow.at<cv::Vec2f>(y, x);
            displacement(x, y) = {way[0], way[1]};
        }
    }
    return displacement;
}

#endif

}  // namespace

Image<std::uint8_t> make_flow_picture(const Image<Rgb>& frame) {
    const Image<float> channel = compute_opponent(frame, OpponentChannel::a, false);
    Image<std::uint8_t> picture(frame.width, frame.height);
    std::transform(channel.pixels.begin(), channel.pixels.end(), picture.pixels.begin(), [](float value) {
        const float root = std::sqrt(value), shown = root <= 1.0f ? 0.85f * root : 1.0f - 0.15f / root;
        return static_cast<std::uint8_t>(255.0f * shown + 0.5f);
    });
    return picture;
}

#if defined(ALEPH_OPENCV)

bool has_flow() {
    return true;
}

FlowPair compute_flow(const Image<std::uint8_t>& first, const Image<std::uint8_t>& second) {
    if (first.empty() || second.empty()) refuse_flow("a picture has no pixels");
    if (!same_size(first, second)) {
        refuse_flow(
            fmt::format("pictures of {}x{} and {}x{} pixels", first.width, first.height, second.width, second.height));
    }
    const PlainOpenCv plain;
    FlowPair pair;
    parallel_each(2, 1, [&](std::size_t i) {
        if (i == 0) {
            pair.there = search(first, second);
        } else {
            pair.back = search(second, first);
        }
    });
    return pair;
}

#else

bool has_flow() {
    return false;
}

FlowPair compute_flow(const Image<std::uint8_t>&, const Image<std::uint8_t>&) {
    refuse_flow("this program was built without OpenCV; install libopencv-video-dev and configure again");
}

#endif

}  // namespace aleph
