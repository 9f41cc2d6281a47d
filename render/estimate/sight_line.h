#pragma once
// The surfaces that the ray through a pixel's centre shows, without chance: those that it meets on its way through
// blended surfaces and glass, and in mirrors.

#include "render/light/light_choice.h"
#include "render/path/path.h"
#include "render/pixels/pixel_surfaces.h"

namespace aleph {

/// The ray that a line of sight begins with.
struct SightStart {
    const CameraView& view;
    glm::ivec2 pixel;
    CameraRay ray;
    Hit hit{};            ///< of the ray, where blended surfaces are cut out
    bool beside = false;  ///< it begins beside the camera, perhaps in other media
};
/// Through a pixel's centre. @param centers  first hits
SightStart start_at_center(const CameraView& view, const SampleHits& centers, const glm::ivec2& pixel);

/// The ray from surface to surface. Blended surfaces and smooth sheets of glass let it pass straight on, smooth walls
/// of volumes refract it. Rough glass, and rough surfaces that reflect much, spread it over several lines, of which
/// this is one. What is reflected is another way on; the reflections of glass are left out.
class SightLine {
  public:
    /// Keeps references.
    /// @param tracer  of Blend::whole
    /// @param number  which of spread_lines it is
    SightLine(const LightingContext& context, Tracer& tracer, const SightStart& start, int number = 0);
    static constexpr int spread_lines = 8;

    /// Goes to the next surface. @return false: there is none, or next to no light would reach the camera from it
    bool advance(RayCounts& counts);
    /// Once there is no further surface: goes back to where a mirror reflects most of what has not been
    /// followed, for advance to go on from there. @return false: next to no light comes from there
    bool reflect();

    const PixelSurface& surface() const { return surface_; }
    /// Share of the surface's light that reaches the camera.
    const Rgb& share() const { return share_; }
    /// Light and media at the surface.
    const LightingContext& lighting() const { return lighting_; }
    /// Emission of the surface: after a turn at a rough surface, less what sampling of lights finds there.
    const Rgb& emission() const { return emission_; }
    /// Lobes of the surface whose rays are followed.
    const LobeShares& followed() const { return followed_; }
    /// Share of the light of what surrounds the scene, once there is no further surface, and the ray's direction.
    const Rgb& left() const { return way_.left; }
    const glm::vec3& direction() const { return way_.ray.direction; }
    /// Weight of the surroundings: after a turn at a rough surface less than 1, as sampling of lights finds them as
    /// well.
    float weight_beyond() const;
    /// Share of the light of what `reflect` goes to, if that is a mirror's.
    Rgb reflected() const {
        return reflected_ && reflected_->turned.emission == EmissionWeight::full ? reflected_->left : Rgb(0.0f);
    }
    /// Returns whether others of spread_lines go elsewhere.
    bool is_spread() const { return spread_; }

  private:
    /// A ray, and what it has behind it.
    struct Way {
        Ray ray;
        Media media;             ///< of the ray, from the last surface on
        float travelled = 0.0f;  ///< m, by the rays before this one
        Rgb left{1.0f};
        PathState turned{};  ///< at a rough surface that reflects; `full`: at none
    };

    Met meet(RayCounts& counts);
    void turn(const LitSurface& lit, const glm::vec3& direction, Way& way) const;
    void note_reflection();
    void note_blurred_reflection();
    void pass_glass(RayCounts& counts);
    void turn_at_glass(const LitSurface& lit);

    LightingContext lighting_;
    Tracer& tracer_;
    SightStart start_;
    int number_;
    Way way_;
    std::optional<Way> reflected_;  ///< not followed yet
    Met last_{};                    ///< on this ray
    bool known_ = false;            ///< it is a first hit
    bool spread_ = false;
    bool blurred_ = false;  ///< a rough surface's reflection is noted or followed, of which there is one at most
    int surfaces_ = 0;
    PixelSurface surface_;
    Rgb share_{0.0f}, emission_{0.0f};
    LobeShares followed_{};
};

/// Sums the light along a pixel's line of sight, or where that is spread the mean of its lines.
/// @param light  has of(line), the radiance of the line's surface, and beyond(line), that of the surroundings
template <class Light>
Rgb add_along_lines(const Light& light, const LightingContext& context, Tracer& tracer, const SightStart& start,
                    RayCounts& counts) {
    Rgb sum(0.0f);
    for (int i = 0;; ++i) {
        SightLine line(context, tracer, start, i);
        do {
            while (line.advance(counts)) sum += line.share() * light.of(line);
            if (line.left() != Rgb(0.0f)) sum += line.left() * light.beyond(line);
        } while (line.reflect());
        if (i == 0 && !line.is_spread()) return sum;
        if (i == SightLine::spread_lines - 1) return sum / static_cast<float>(SightLine::spread_lines);
    }
}

/// The surfaces of each pixel's line of sight that a good part of its light comes from, from near to far, and nothing
/// where the surroundings or a reflection are seen: one image for each, as many as there are before some pixel, and
/// four at most. Where a pixel shows no further one, its first hit. Empty where no pixel shows more than that.
std::vector<Image<Hit>> find_layers(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                                    RayCounts& counts);

}  // namespace aleph
