#include "render/light/bright_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "engine/base/sampling.h"
#include "render/light/light_rays.h"
#include "render/light/lights.h"
#include "render/settings/numbers.h"

namespace aleph {

namespace {

constexpr int fewest_rays = 4;  // that tell of a triangle

/// Radiance of a bright triangle over the mean, of all that light rays meet or of a room as large as what is seen.
constexpr double bright_over_mean = 4.0;

/// Share that bright triangles must have of the mean square of radiance, which is the noise of rays over a hemisphere.
/// A third of the rays are aimed at them: what the others tell has half as much more.
constexpr double least_share = 0.5;

constexpr std::size_t most_places = 128;  // that decide which sides count, about
constexpr float room_behind = 1.5f;       // size of the target of light from afar, over that of what is seen

constexpr float least_rise = 1e-6f;  // of a unit direction above the true surface: below it, rounding decides

/// A triangle is divided where more rays than this met it, in four, and these again, so many times.
constexpr std::size_t most_rays_undivided = 64;
constexpr int most_divisions = 6;
/// A quarter brighter than its triangle by this factor stays apart from the others.
constexpr double uneven = 2.0;

/// One side of a triangle, or of a part of it.
struct LitSide {
    LitPlace sum;
    int rays = 0;
    Emitter::Triangle triangle;   ///< its normal on this side
    float area = 0.0f;            ///< m2
    std::vector<int> quarters{};  ///< from the whole triangle to this part
    double radiance() const { return sum.reflected / (std::numbers::pi * area); }
};

/// Takes barycentric coordinates of a triangle to those of the quarter that they lie in: at one of its corners (0 to
/// 2), or in the middle, turned about (3).
int enter_quarter(glm::vec2& place) {
    if (place.x >= 0.5f) {
        place = {2.0f * place.x - 1.0f, 2.0f * place.y};
        return 1;
    }
    if (place.y >= 0.5f) {
        place = {2.0f * place.x, 2.0f * place.y - 1.0f};
        return 2;
    }
    if (place.x + place.y < 0.5f) {
        place *= 2.0f;
        return 0;
    }
    place = 1.0f - 2.0f * place;
    return 3;
}

Emitter::Triangle find_quarter(const Emitter::Triangle& t, int quarter) {
    const glm::vec3 to_corner[4] = {glm::vec3(0.0f), t.edge1, t.edge2, t.edge1 + t.edge2};
    const float half = quarter == 3 ? -0.5f : 0.5f;
    return {t.corner + 0.5f * to_corner[quarter], half * t.edge1, half * t.edge2, t.normal, t.primitive};
}

/// Adds up the light of rays that met one triangle, or its parts where that is uneven.
/// @param whole  the triangle, without light
void add_parts(std::span<LitPlace> places, const LitSide& whole, std::vector<LitSide>& sides) {
    LitSide all = whole;
    for (const LitPlace& lit : places) all.sum.reflected += lit.reflected;
    all.rays = static_cast<int>(places.size());
    if (places.size() <= most_rays_undivided || std::ssize(whole.quarters) == most_divisions) {
        sides.push_back(std::move(all));
        return;
    }
    std::vector<std::pair<int, LitPlace>> divided;
    for (LitPlace lit : places) {
        const int quarter = enter_quarter(lit.barycentric);
        divided.emplace_back(quarter, lit);
    }
    std::ranges::stable_sort(divided, {}, &std::pair<int, LitPlace>::first);
    std::ranges::transform(divided, places.begin(), &std::pair<int, LitPlace>::second);
    const std::size_t before = sides.size();
    auto begin = divided.begin();
    for (int quarter = 0; quarter < 4; ++quarter) {
        LitSide part = whole;
        part.triangle = find_quarter(whole.triangle, quarter);
        part.area = 0.25f * whole.area;
        part.quarters.push_back(quarter);
        const auto end = std::ranges::find_if(begin, divided.end(), [&](const auto& a) { return a.first != quarter; });
        add_parts(places.subspan(begin - divided.begin(), end - begin), part, sides);
        begin = end;
    }
    const auto stands_out = [&](const LitSide& part) {
        return part.quarters.size() > whole.quarters.size() + 1 || part.radiance() > uneven * all.radiance();
    };
    if (std::ranges::any_of(sides.begin() + static_cast<std::ptrdiff_t>(before), sides.end(), stands_out)) return;
    sides.resize(before);
    sides.push_back(std::move(all));
}

/// The sides of triangles that light rays met, with the sums of their light.
std::vector<LitSide> add_up(const ShadingScene& shading, std::vector<LitPlace> places) {
    std::erase_if(places, [](const LitPlace& a) { return a.instance == no_index; });
    const auto side_of = [](const LitPlace& a) { return std::tuple(a.instance, a.primitive, a.behind); };
    std::ranges::stable_sort(places, {}, side_of);
    std::vector<LitSide> sides;
    for (auto begin = places.begin(); begin != places.end();) {
        const auto end =
            std::find_if(begin, places.end(), [&](const LitPlace& a) { return side_of(a) != side_of(*begin); });
        LitSide side{.sum = *begin, .triangle = place_triangle(shading.instances[begin->instance], begin->primitive)};
        side.sum.reflected = 0.0;
        side.area = 0.5f * glm::length(glm::cross(side.triangle.edge1, side.triangle.edge2));
        if (begin->behind) side.triangle.normal = -side.triangle.normal;
        add_parts({begin, end}, side, sides);
        begin = end;
    }
    return sides;
}

Emitter make_patch(const LitSide& side) {
    Emitter patch;
    patch.instance = side.sum.instance;
    patch.radiance = patch.brightest = Rgb(static_cast<float>(side.radiance()));
    const auto shape = std::make_shared<EmitterShape>();
    shape->triangles = {side.triangle};
    measure(*shape);
    set_shape(shape, patch);
    return patch;
}

double add_squares(const std::vector<LitSide>& sides) {
    double sum = 0.0;
    for (const LitSide& side : sides) sum += side.sum.reflected * side.radiance();
    return sum;
}

/// Returns whether some of the side is above the place's horizon, and the place in front of it.
bool faces(const LitSide& side, const Receiver& place) {
    const Emitter::Triangle& t = side.triangle;
    const glm::vec3 to = t.corner - place.position;
    const float rounding = 1e-4f * (glm::length(to) + glm::length(t.edge1) + glm::length(t.edge2));
    const float corner = glm::dot(to, place.normal);
    const float highest =
        std::max({corner, corner + glm::dot(t.edge1, place.normal), corner + glm::dot(t.edge2, place.normal)});
    return glm::dot(to, t.normal) < -rounding && highest > rounding;
}

/// The bright sides, if they have enough of the light; else none.
std::vector<LitSide> find_bright_sides(const LightingContext& context, std::span<const Receiver> places,
                                       std::size_t light_rays, RayCounts& counts) {
    BoundingBox box;
    for (const Receiver& place : places) box.add(place.position);
    const glm::vec3 size = box.high - box.low;
    const double faces_of_box = 2.0f * (size.x * size.y + size.y * size.z + size.z * size.x);  // m2
    const BoundingSphere target{box.center(), 0.5f * room_behind * glm::length(size)};
    std::vector<LitSide> sides = add_up(context.shading, cast_light_rays(context, target, light_rays, counts));
    std::erase_if(sides, [&](const LitSide& side) {
        return std::ranges::none_of(places, [&](const Receiver& place) { return faces(side, place); });
    });
    double reflected = 0.0, area = 0.0;
    for (const LitSide& side : sides) {
        reflected += side.sum.reflected;
        area += side.area;
    }
    area = std::max(area, faces_of_box);  // light may leave most of a room dark
    std::erase_if(sides, [](const LitSide& side) { return side.rays < fewest_rays || !(side.area > 0.0f); });
    const double all = add_squares(sides);
    std::erase_if(sides, [&](const LitSide& side) {
        return !(side.radiance() * area > bright_over_mean * reflected / std::numbers::pi);
    });
    std::ranges::stable_sort(sides, std::ranges::greater{}, [](const LitSide& side) { return side.sum.reflected; });
    sides.resize(std::min(sides.size(), BrightSurfaces::most));
    if (!(add_squares(sides) > least_share * all)) sides.clear();
    return sides;
}

BrightSurfaces make_bright_surfaces(const ShadingScene& shading, const std::vector<LitSide>& sides) {
    BrightSurfaces found;
    found.part_of.resize(shading.instances.size());
    for (const LitSide& side : sides) {
        std::vector<int>& part_of = found.part_of[side.sum.instance];
        if (part_of.empty()) part_of.resize(shading.instances[side.sum.instance].mesh->triangles.size(), no_index);
        int& whole = part_of[side.sum.primitive];
        if (whole == no_index) {
            whole = static_cast<int>(found.parts.size());
            found.parts.push_back({.behind = side.sum.behind});
        }
        int part = whole;
        if (found.parts[part].behind != side.sum.behind) continue;  // its other side is brighter
        for (const int quarter : side.quarters) {
            if (found.parts[part].quarters == no_index) {
                found.parts[part].quarters = static_cast<int>(found.parts.size());
                found.parts.resize(found.parts.size() + 4, {.behind = side.sum.behind});
            }
            part = found.parts[part].quarters + quarter;
        }
        found.parts[part].patch = static_cast<int>(found.patches.emitters.size());
        found.patches.emitters.push_back(make_patch(side));
    }
    found.patches.bounds = make_light_bounds(shading, found.patches);
    return found;
}

}  // namespace

int BrightSurfaces::find(const Hit& hit, const glm::vec3& direction) const {
    if (hit.instance == no_index || part_of[hit.instance].empty()) return no_index;
    int part = part_of[hit.instance][hit.primitive];
    if (part == no_index) return no_index;
    for (glm::vec2 place(hit.u, hit.v); parts[part].quarters != no_index;)
        part = parts[part].quarters + enter_quarter(place);
    const int patch = parts[part].patch;
    if (patch == no_index) return no_index;
    return glm::dot(patches.emitters[patch].shape->triangles.front().normal, direction) < 0.0f ? patch : no_index;
}

BrightSurfaces find_bright_surfaces(const LightingContext& context, std::span<const Receiver> places,
                                    RayCounts& counts) {
    std::vector<Receiver> some;
    const std::size_t step = std::max<std::size_t>(1, places.size() / most_places);
    for (std::size_t i = 0; i < places.size(); i += step) some.push_back(places[i]);
    if (some.empty() || find_bright_sides(context, some, BrightSurfaces::light_rays, counts).empty()) return {};
    return make_bright_surfaces(context.shading,
                                find_bright_sides(context, some, BrightSurfaces::more_light_rays, counts));
}

BrightSampler::BrightSampler(const BrightSurfaces& surfaces, const Receiver& receiver, int around, int towards)
    : surfaces_(surfaces),
      receiver_(receiver),
      aimed_per_around_(static_cast<float>(towards) / static_cast<float>(around)) {
    const LightBounds& bounds = surfaces.patches.bounds;
    bound_illuminances(bounds, receiver, {ends_.data(), bounds.strength.size()});
    for (std::size_t i = 0; i < bounds.strength.size(); ++i) ends_[i] = total_ += ends_[i];
    if (!std::isfinite(total_)) total_ = 0.0f;
}

BrightSampler::Aim BrightSampler::aim(const LightNumbers& numbers) const {
    const std::vector<Emitter>& patches = surfaces_.patches.emitters;
    if (!(total_ > 0.0f)) return {};
    const std::span ends(ends_.data(), patches.size());
    const auto found = std::ranges::upper_bound(ends, numbers.choice * total_) - ends.begin();
    const int patch = static_cast<int>(std::min(found, std::ssize(ends) - 1));
    const Emitter::Triangle& t = patches[static_cast<std::size_t>(patch)].shape->triangles.front();
    const glm::vec2 b = sample_triangle(numbers.point);
    const glm::vec3 to = t.corner + t.edge1 * b.x + t.edge2 * b.y - receiver_.position;
    const float distance = glm::length(to);
    if (!(distance > 0.0f) || !(glm::dot(to, t.normal) < 0.0f)) return {};
    const glm::vec3 direction = to / distance;
    return glm::dot(direction, receiver_.normal) > least_rise ? Aim{direction, patch, t.normal} : Aim{};
}

float BrightSampler::density(int patch, const glm::vec3& direction, float distance) const {
    const auto i = static_cast<std::size_t>(patch);
    const Emitter& emitter = surfaces_.patches.emitters[i];
    const float share = (ends_[i] - (i == 0 ? 0.0f : ends_[i - 1])) / total_;
    const float cosine = -glm::dot(emitter.shape->triangles.front().normal, direction);
    return cosine > 0.0f ? share * distance * distance / (cosine * emitter.area) : 0.0f;
}

float BrightSampler::weigh(const Hit& hit, const glm::vec3& direction, int patch) const {
    const int met = total_ > 0.0f ? surfaces_.find(hit, direction) : no_index;
    if (patch != no_index && met != patch) return 0.0f;
    if (met == no_index) return 1.0f;
    const float cosine = glm::dot(receiver_.normal, direction);
    const float weight = cosine / (cosine + aimed_per_around_ * pi * density(met, direction, hit.distance));
    return std::isfinite(weight) ? weight : 0.0f;
}

}  // namespace aleph
