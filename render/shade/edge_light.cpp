#include "render/shade/edge_light.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "engine/base/parallel.h"
#include "engine/base/pixel_loops.h"
#include "render/pixels/pixel_sequence.h"
#include "render/shade/picture_polygon.h"

namespace aleph {

namespace {

constexpr int packet = 16;
constexpr int rays_of_a_sample = 16;
constexpr int first_piece_rays = 64, first_sky_rays = 256;  // of a pixel's first set
constexpr double covered_square = 0.9999;                   // share of a filter's square that is as good as all of it
constexpr int parts_of_a_set = 8;                           // which tell its error
constexpr double small_piece = 0.5;                         // pixels: the filter is about even over it
constexpr double share_of_energy = 0.25;                    // of the error that pixels may have
constexpr double variance_of_half = 2.0;                    // of half as many rays, over that of all
constexpr std::uint32_t edge_key_mask = 0x65646765u;        // apart from the samples' own places

/// Errors that pixels may have.
struct EdgeLimits {
    const SamplingPlan& plan;
    Image<float> density;  ///< share of the pixels that are seen together that have a bright edge; empty: no limit
};

/// The part of a piece that lies in a pixel's filter.
struct PieceInFilter {
    BrightPiece piece;
    PicturePolygon polygon;
    double weight = 0.0;      ///< about its share of the filter
    double brightness = 0.0;  ///< luminance, of the sky
    double density = 0.0;     ///< of its rays, per square pixel
};

/// Returns whether a ray met one of the pieces.
bool meets(const ShadingScene& shading, const BrightEdges& edges, const Hit& hit, const glm::vec3& direction,
           std::span<const BrightPiece> pieces) {
    int primitive = hit.primitive;
    if (hit.instance == no_index)
        primitive = edges.cells ? edges.cells->find(direction * shading.environment.rotation) : no_index;
    return std::ranges::any_of(pieces,
                               [&](const BrightPiece& piece) { return piece.contains(hit.instance, primitive); });
}

std::span<const BrightPiece> pieces_of(const BrightEdges& edges, const EdgeLight& edge) {
    return std::span(edges.pieces).subspan(edge.first, edge.last - edge.first);
}

/// Rays of one pixel.
class EdgeRays {
  public:
    EdgeRays(const SampleScene& scene, RayTask& task, const SamplePlace& place, const BrightEdges& edges,
             const EdgeLight& light)
        : scene_(scene),
          task_(task),
          place_(place),
          edges_(edges),
          light_(light),
          middle_(light.x + 0.5, light.y + 0.5) {
        for (std::size_t i = light.first; i < light.last; ++i) {
            const PieceInFilter part = find_part(edges.pieces[i]);
            if (part.weight > 0.0) parts_.push_back(part);
        }
        weigh_sky();
        double sum = 0.0, end = 0.0;
        for (const PieceInFilter& part : parts_) sum += part.weight;
        const double side = 2.0 * place_in_filter(place_.filter, 1.0);
        double area = 0.0;
        for (const PieceInFilter& part : parts_) area += area_of(part.polygon);
        whole_ = area >= covered_square * side * side;
        for (PieceInFilter& part : parts_) {
            ends_.push_back(static_cast<float>(end += part.weight / sum));
            part.density = part.weight / sum / area_of(part.polygon);
        }
    }

    /// The sum over the rays of one set from `first` to `last`.
    Rgb cast(std::uint32_t set, int first, int last) {
        place_.noise_key ^= edge_key_mask + set;
        Rgb sum(0.0f);
        for (int begin = first; begin < last; begin += packet) {
            const int count = std::min(packet, last - begin);
            if (!parts_.empty() && !whole_) sum += cast_to_pieces(begin, count);
            if (light_.sky || whole_) sum += cast_through_filter(begin, count);
        }
        place_.noise_key ^= edge_key_mask + set;
        return sum;
    }

  private:
    PieceInFilter find_part(const BrightPiece& piece) const {
        const double radius = place_in_filter(place_.filter, 1.0);
        const PicturePolygon whole = project_piece(scene_.view, scene_.lighting.shading, edges_, piece);
        PieceInFilter part{piece, clip_to_rectangle(whole, middle_ - radius, middle_ + radius)};
        const double area = area_of(part.polygon);
        if (!(area > 0.0)) return part;
        double size = 0.0;
        for (int i = 1; i < part.polygon.count; ++i)
            size = std::max(size, glm::distance(part.polygon.corners[0], part.polygon.corners[i]));
        const int places = size < small_piece ? 2 : 8;
        for (int i = 0; i < places; ++i)
            part.weight += weigh(sample_polygon(part.polygon, lattice_point(i, places, {0.0f, 0.3f})));
        part.weight *= area / places;
        if (piece.instance == no_index) part.brightness = double{edges_.cells->find_range(piece.primitive).most};
        return part;
    }

    /// Parts of the sky count by their brightness: the brightest as much as a lamp.
    void weigh_sky() {
        double most = 0.0;
        for (const PieceInFilter& part : parts_) most = std::max(most, part.brightness);
        for (PieceInFilter& part : parts_)
            if (part.piece.instance == no_index) part.weight *= part.brightness / most;
    }

    /// Density of the filter at a place of the picture.
    double weigh(const glm::dvec2& place) const {
        const glm::dvec2 away = place - middle_;
        return filter_density(place_.filter, away.x) * filter_density(place_.filter, away.y);
    }

    void intersect(int count) {
        task_.tracer.intersect(std::span(rays_.data(), static_cast<std::size_t>(count)),
                               std::span(hits_.data(), static_cast<std::size_t>(count)));
        task_.counts.primary += static_cast<std::uint64_t>(count);
    }

    Rgb cast_to_pieces(int begin, int count) {
        const PixelSequence sequence(place_.seed, place_.noise_key, light_.x, light_.y);
        std::array<const PieceInFilter*, packet> chosen{};
        std::array<float, packet> weights{};
        for (int i = 0; i < count; ++i) {
            // One number chooses the piece and, stretched, the place on it: rays are even over all pieces together.
            glm::vec2 u = sequence.at_2d(SampleUse::bright_point, begin + i);
            chosen[i] = &parts_[choose_part(ends_, u.x)];
            const glm::dvec2 at = sample_polygon(chosen[i]->polygon, u);
            weights[i] = static_cast<float>(weigh(at) / chosen[i]->density);
            CameraRay ray = make_camera_ray(scene_.view, at.x, at.y);
            if (place_.blend == Blend::random) ray.choice = sequence.at_1d(SampleUse::passing, begin + i);
            rays_[i] = to_scene(scene_.lighting.rays, ray);
        }
        intersect(count);
        Rgb sum(0.0f);
        for (int i = 0; i < count; ++i) {
            if (meets(scene_.lighting.shading, edges_, hits_[i], rays_[i].direction, {&chosen[i]->piece, 1}))
                sum += weights[i] *
                       find_emission(scene_, task_, place_, hits_[i], rays_[i].direction, {light_.x, light_.y});
        }
        return sum;
    }

    /// Finds what is left of the sky, and pieces that fill the filter: there these rays are best.
    Rgb cast_through_filter(int begin, int count) {
        SamplePlace own = place_;
        for (int i = 0; i < count; ++i) {
            own.index = begin + i;
            rays_[i] = to_scene(scene_.lighting.rays, make_sample_ray(scene_.view, own, light_.x, light_.y));
        }
        intersect(count);
        Rgb sum(0.0f);
        for (int i = 0; i < count; ++i) {
            const bool is_left = hits_[i].instance == no_index && !meets(scene_.lighting.shading, edges_, hits_[i],
                                                                         rays_[i].direction, pieces_of(edges_, light_));
            if (whole_ || is_left)
                sum += light_in_edge(scene_, task_, place_, edges_, light_, hits_[i], rays_[i].direction);
        }
        return sum;
    }

    const SampleScene& scene_;
    RayTask& task_;
    SamplePlace place_;
    const BrightEdges& edges_;
    const EdgeLight& light_;
    const glm::dvec2 middle_;
    std::vector<PieceInFilter> parts_;
    std::vector<float> ends_;  ///< share of the rays up to each of them, it included
    bool whole_ = false;       ///< they fill the filter
    std::array<Ray, packet> rays_;
    std::array<Hit, packet> hits_;
};

/// Casts one set of rays, 16 or more.
void take_set(EdgeRays& rays, std::uint32_t set, int count, EdgeLight& light) {
    const int parts = std::min(count / 8, parts_of_a_set);
    glm::dvec3 sum(0.0);
    double mean = 0.0, squares = 0.0;  // of the parts (Welford 1962)
    for (int part = 0; part < parts; ++part) {
        const auto begin = static_cast<int>(std::int64_t{count} * part / parts);
        const auto end = static_cast<int>(std::int64_t{count} * (part + 1) / parts);
        const Rgb of_part = rays.cast(set, begin, end);
        sum += glm::dvec3(of_part);
        const double y = luminance(of_part) / (end - begin), difference = y - mean;
        mean += difference / (part + 1);
        squares += difference * (y - mean);
    }
    light.mean = Rgb(sum / static_cast<double>(count));
    light.variance = static_cast<float>(squares / (parts * (parts - 1)));
}

/// Returns whether the next set, twice as large, may be the last.
bool tells_enough(const EdgeLight& light, const EdgeLimits& limits) {
    const SamplingPlan& plan = limits.plan;
    const double least = std::min({light.mean.x, light.mean.y, light.mean.z}), variance = light.variance;
    const double deviations = 3.0 * std::sqrt(variance) / std::max(1e-30, double{luminance(light.mean)});
    // While the shutter is open, what moves may be white at its centre and not in the picture.
    const bool changes = !plan.least.empty() && plan.least(light.x, light.y) > 1;
    if (!changes && least * (1.0 - deviations) > plan.white) return true;
    const double tolerance = plan.tolerance(light.x, light.y) / error_deviations;
    return variance * limits.density(light.x, light.y) <= share_of_energy * variance_of_half * tolerance * tolerance;
}

void take_sets(EdgeRays& rays, const EdgeLimits& limits, EdgeLight& light) {
    const int most = rays_of_a_sample * limits.plan.most, first = light.sky ? first_sky_rays : first_piece_rays;
    int count = limits.density.empty() ? most : std::min(first, most);
    bool is_last = count == most;
    for (std::uint32_t set = 0;; ++set) {
        take_set(rays, set, count, light);
        if (is_last) return;
        count = std::min(2 * count, most);
        is_last = count == most || tells_enough(light, limits);
    }
}

std::vector<EdgeLight> list_edges(const BrightEdges& edges, const PicturePart* part) {
    std::vector<EdgeLight> pixels;
    std::size_t next = 0;
    for (int y = 0; y < edges.sky.height; ++y) {
        for (int x = 0; x < edges.sky.width; ++x) {
            const std::size_t first = next;
            while (next < edges.pieces.size() && edges.pieces[next].x == x && edges.pieces[next].y == y) ++next;
            const bool is_wanted = part == nullptr || (*part)(x, y) != 0, sky = edges.sky(x, y) != 0;
            if (is_wanted && (sky || next > first))
                pixels.push_back({.x = x, .y = y, .sky = sky, .first = first, .last = next});
        }
    }
    return pixels;
}

}  // namespace

EdgeLights::EdgeLights(BrightEdges found, std::vector<EdgeLight> light)
    : edges(std::move(found)), pixels(std::move(light)) {
    if (pixels.empty()) return;
    places = Image<int>(edges.sky.width, edges.sky.height, no_index);
    for (std::size_t i = 0; i < pixels.size(); ++i) places(pixels[i].x, pixels[i].y) = static_cast<int>(i);
}

EdgeLights find_edge_light(const SampleScene& scene, const SamplePlace& place, const SamplingPlan& plan,
                           BrightEdges edges, std::uint64_t& rays_cast) {
    std::vector<EdgeLight> found = list_edges(edges, plan.part);
    EdgeLimits limits{plan, {}};
    if (!plan.tolerance.empty() && !found.empty()) {
        limits.density = Image<float>(edges.sky.width, edges.sky.height);
        for (const EdgeLight& light : found) limits.density(light.x, light.y) = 1.0f;
        limits.density = mean_around(limits.density, plan.reach, true);
    }
    std::atomic<std::uint64_t> rays_of_all = 0;
    parallel_for(found.size(), 4, [&](std::size_t first, std::size_t last) {
        RayTask task(scene.lighting.rays);
        for (std::size_t i = first; i < last; ++i) {
            EdgeRays rays(scene, task, place, edges, found[i]);
            take_sets(rays, limits, found[i]);
        }
        rays_of_all += task.counts.primary;
    });
    rays_cast += rays_of_all;
    // Light that is no number stays with the samples that meet it.
    std::erase_if(found, [](const EdgeLight& light) { return !is_finite(light.mean); });
    return {std::move(edges), std::move(found)};
}

Rgb sample_edge_light(const SampleScene& scene, RayTask& task, const SamplePlace& place, const BrightEdges& edges,
                      const EdgeLight& edge) {
    const auto set = static_cast<std::uint32_t>(place.index);
    return EdgeRays(scene, task, place, edges, edge).cast(set, 0, rays_of_a_sample) / float{rays_of_a_sample};
}

Rgb light_in_edge(const SampleScene& scene, RayTask& task, const SamplePlace& place, const BrightEdges& edges,
                  const EdgeLight& edge, const Hit& hit, const glm::vec3& direction) {
    const bool is_known = (edge.sky && hit.instance == no_index) ||
                          meets(scene.lighting.shading, edges, hit, direction, pieces_of(edges, edge));
    return is_known ? find_emission(scene, task, place, hit, direction, {edge.x, edge.y}) : Rgb(0.0f);
}

}  // namespace aleph
