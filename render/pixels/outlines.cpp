#include "render/pixels/outlines.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/parallel.h"

namespace aleph {

namespace {

constexpr double least_step = 0.5;        // pixels, from a plane
constexpr double different_motion = 0.5;  // pixels per frame
constexpr float least_contrast = 0.5f;    // of what is tolerated

class OutlineFinder {
  public:
    OutlineFinder(const CameraView& view, const Image<Hit>& hits, const MotionField& motion)
        : view_(view), hits_(hits), motion_(motion) {}

    Outline find(int x, int y) const {
        if (!has_outline(x, y)) return Outline::none;
        return moves_differently(x, y) ? Outline::moving : Outline::still;
    }

  private:
    bool has_outline(int x, int y) const {
        const int own = hits_(x, y).instance;
        const int left = std::max(0, x - 1), right = std::min(hits_.width - 1, x + 1);
        for (int ny = std::max(0, y - 1); ny <= std::min(hits_.height - 1, y + 1); ++ny) {
            for (int nx = left; nx <= right; ++nx) {
                if (hits_(nx, ny).instance != own) return true;
            }
        }
        if (own == no_index || x == 0 || y == 0 || x == hits_.width - 1 || y == hits_.height - 1) return false;
        constexpr std::array<std::array<int, 2>, 4> axes{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
        return std::ranges::any_of(axes, [&](const auto& axis) {
            return bends(hits_(x - axis[0], y - axis[1]), hits_(x, y), hits_(x + axis[0], y + axis[1]));
        });
    }

    /// Returns whether three neighbours in a row do not lie on a plane.
    bool bends(const Hit& before, const Hit& here, const Hit& after) const {
        const double a = before.distance, b = here.distance, c = after.distance;
        const double bend = view_.orthographic ? a - 2.0 * b + c : b / a - 2.0 + b / c;
        return std::abs(bend) * view_.pixels_per_unit > least_step;
    }

    bool moves_differently(int x, int y) const {
        if (motion_.displacement.empty()) return false;
        const glm::dvec2 own = motion_.displacement(x, y);
        for (int ny = std::max(0, y - 1); ny <= std::min(hits_.height - 1, y + 1); ++ny) {
            for (int nx = std::max(0, x - 1); nx <= std::min(hits_.width - 1, x + 1); ++nx) {
                const glm::dvec2 other = motion_.displacement(nx, ny);
                if (std::hypot(other.x - own.x, other.y - own.y) > different_motion) return true;
            }
        }
        return false;
    }

    const CameraView& view_;
    const Image<Hit>& hits_;
    const MotionField& motion_;
};

}  // namespace

Image<Outline> find_outlines(const CameraView& view, const Image<Hit>& hits, const MotionField& motion) {
    Image<Outline> outlines(hits.width, hits.height);
    const OutlineFinder finder(view, hits, motion);
    parallel_rows(hits.height, 16, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < hits.width; ++x) outlines(x, y) = finder.find(x, y);
        }
    });
    return outlines;
}

void mark_contrasts(Image<Outline>& outlines, const Image<Rgb>& estimate, const Image<float>& threshold,
                    double tolerated) {
    const float least = least_contrast * static_cast<float>(tolerated);
    const auto has_contrast = [&](int x, int y) {
        float low = luminance(estimate(x, y)), high = low;
        for (int ny = std::max(0, y - 1); ny <= std::min(estimate.height - 1, y + 1); ++ny) {
            for (int nx = std::max(0, x - 1); nx <= std::min(estimate.width - 1, x + 1); ++nx) {
                low = std::min(low, luminance(estimate(nx, ny)));
                high = std::max(high, luminance(estimate(nx, ny)));
            }
        }
        return high - low > least * threshold(x, y);
    };
    parallel_rows(outlines.height, 16, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < outlines.width; ++x) {
                if (outlines(x, y) == Outline::none && has_contrast(x, y)) outlines(x, y) = Outline::still;
            }
        }
    });
}

}  // namespace aleph
