#include "render/light/lights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/sampling.h"
#include "render/surface/environment_map.h"
#include "render/surface/surface_material.h"

namespace aleph {

namespace {

/// The part of v perpendicular to the unit vector n, unit.
glm::vec3 perpendicular(const glm::vec3& v, const glm::vec3& n) {
    const glm::vec3 p = v - n * glm::dot(v, n);
    const float length = glm::length(p);
    return length > 0.0f ? p / length : glm::vec3(0.0f);
}

/// Shadow rays end before the light, so that they do not hit it, by this share of the distance at most.
constexpr float most_shortened = 1e-4f;

/// m: length of a shadow ray to a light at a distance. It ends before the light by more than the rounding error of a
/// point on a lamp and of where a ray meets its plane.
/// @param largest  m, of the light's coordinates
/// @param cosine   at which rays meet it
float shadow_length(float distance, float largest, float cosine) {
    const float rounding = std::max(0x1p-17f * distance, 0x1p-20f * largest) / cosine;
    return distance - std::min(rounding, most_shortened * distance);
}

float largest_coordinate(const glm::vec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

/// Stands for the cosine at lights without area: they may lie in a surface, such as a ceiling.
constexpr float any_cosine = 0.5f;

FacingSides find_facing_sides(const Emitter& emitter, const glm::vec3& position) {
    FacingSides facing;
    const std::vector<Emitter::Side>& sides = emitter.shape->sides;
    if (sides.empty()) return facing;
    // In the coordinates of the shape: the inverse of a rotation is its transpose.
    const glm::vec3 from = (position - emitter.center) * emitter.turn / (emitter.scale * emitter.scale);
    const float rounding = 1e-5f * (glm::length(from) + emitter.shape->radius);
    facing.share = 0.0f;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const Emitter::Side& side = sides[i];
        const glm::vec3 most = glm::max(glm::vec3(side.low) * from, glm::vec3(side.high) * from);
        if (!(most.x + most.y + most.z - side.low.w > -rounding)) continue;
        facing.which |= 1u << i;
        facing.share += side.end - side.begin;
    }
    return facing;
}

/// A number in [0, 1) among the facing sides, as one among all.
float place_in_sides(const Emitter& emitter, const FacingSides& facing, float u) {
    float left = u * facing.share, place = u;
    const std::vector<Emitter::Side>& sides = emitter.shape->sides;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if ((facing.which >> i & 1u) == 0) continue;
        const Emitter::Side& side = sides[i];
        place = std::min(side.begin + left, below_one * side.end);  // the last one, if rounding leaves something
        left -= side.end - side.begin;
        if (left < 0.0f) break;
    }
    return place;
}

/// sr. Above it, sampling by area is the noisier way, and float is accurate enough for the angles.
constexpr float min_solid_angle = 0.1f;

SolidAngles find_solid_angles(const Emitter& emitter, const glm::vec3& position) {
    SolidAngles angles;
    if (emitter.size() > max_spherical_triangles) return angles;
    const glm::vec3 away = emitter.center - position;
    const float nearest = std::max(0.0f, glm::length(away) - emitter.radius);
    if (emitter.area < min_solid_angle * nearest * nearest) return angles;
    for (std::size_t i = 0; i < emitter.size(); ++i) {
        const Emitter::Triangle t = emitter.triangle(i);
        const glm::vec3 corner = t.corner - position;
        if (!emitter.double_sided && !(glm::dot(corner, t.normal) < 0.0f)) continue;
        angles.of[i] = solid_angle(corner, corner + t.edge1, corner + t.edge2);
        angles.total += angles.of[i];
    }
    if (!(angles.total > min_solid_angle)) angles.total = 0.0f;
    return angles;
}

/// Barycentric (b1, b2) of the point where a ray meets the triangle's plane, clamped into the triangle.
glm::vec2 meet_triangle(const Emitter::Triangle& t, const glm::vec3& position, const glm::vec3& direction) {
    const glm::vec3 p = glm::cross(direction, t.edge2), s = position - t.corner;
    const float determinant = glm::dot(t.edge1, p);
    if (determinant == 0.0f) return {1.0f / 3.0f, 1.0f / 3.0f};
    glm::vec2 b(glm::dot(s, p) / determinant, glm::dot(direction, glm::cross(s, t.edge1)) / determinant);
    b = glm::clamp(b, glm::vec2(0.0f), glm::vec2(1.0f));
    return b.x + b.y > 1.0f ? b / (b.x + b.y) : b;
}

/// The place of a triangle in this direction; u in [0,1)^2.
EmitterPlace sample_by_angle(const Emitter& emitter, const SolidAngles& angles, const glm::vec3& position,
                             glm::vec2 u) {
    std::array<float, max_spherical_triangles> ends{};
    float sum = 0.0f;
    for (std::size_t i = 0; i < emitter.size(); ++i) ends[i] = (sum += angles.of[i]) / angles.total;
    const auto chosen = static_cast<std::size_t>(choose_part(std::span(ends.data(), emitter.size()), u.x));
    const Emitter::Triangle t = emitter.triangle(chosen);
    const glm::vec3 corner = t.corner - position;
    const glm::vec2 b = meet_triangle(
        t, position, sample_spherical_triangle(corner, corner + t.edge1, corner + t.edge2, angles.of[chosen], u));
    return {chosen, b, spread_of(emitter, t.primitive, b)};
}

/// Share of the samples of a near emitter that go by solid angle.
float share_by_angle(const Emitter& emitter, const SeenLight& seen) {
    if (!(seen.angles.total > 0.0f)) return 0.0f;
    return emitter.shape->cells.empty() ? 1.0f : 0.5f;
}

EmitterPlace choose_place(const Emitter& emitter, const SeenLight& seen, const glm::vec3& position, glm::vec2 u) {
    const float by_angle = share_by_angle(emitter, seen);
    if (u.x < by_angle) return sample_by_angle(emitter, seen.angles, position, {u.x / by_angle, u.y});
    u.x = place_in_sides(emitter, seen.facing, (u.x - by_angle) / (1.0f - by_angle));
    const int triangle = choose_part(emitter.shape->cumulative, u.x);
    return sample_place(emitter, static_cast<std::size_t>(triangle), u);
}

/// Density per solid angle of choose_place.
float pdf_place(const Emitter& emitter, const SeenLight& seen, float spread, float cosine, float distance) {
    const float by_angle = share_by_angle(emitter, seen);
    float pdf = by_angle > 0.0f ? by_angle / seen.angles.total : 0.0f;
    if (by_angle < 1.0f) pdf += (1.0f - by_angle) * distance * distance / (cosine * spread * seen.facing.share);
    return pdf;
}

SeenLight see_emitter(const Emitter& emitter, int light, const glm::vec3& position) {
    SeenLight seen{light, find_solid_angles(emitter, position), {}};
    if (!(seen.angles.total > 0.0f)) seen.facing = find_facing_sides(emitter, position);
    return seen;
}

LightSample sample_emitter(const ShadingScene& shading, const Emitter& emitter, const SeenLight& seen,
                           const glm::vec3& position, const glm::vec2& u, float share) {
    if (!(seen.facing.share > 0.0f)) return {};
    const EmitterPlace place = choose_place(emitter, seen, position, u);
    const Emitter::Triangle triangle = emitter.triangle(place.triangle);
    const glm::vec2 b = place.b;
    const glm::vec3 to_light = triangle.corner + triangle.edge1 * b.x + triangle.edge2 * b.y - position;
    const float distance2 = glm::dot(to_light, to_light);
    LightSample sample;
    if (!(distance2 > 0.0f)) return sample;
    const float distance = std::sqrt(distance2);
    sample.direction = to_light / distance;
    float cosine = -glm::dot(sample.direction, triangle.normal);
    if (emitter.double_sided) cosine = std::abs(cosine);
    if (!(cosine > 0.0f)) return sample;
    sample.distance = shadow_length(distance, largest_coordinate(emitter.center) + emitter.radius, cosine);
    sample.pdf = pdf_place(emitter, seen, place.spread, cosine, distance);
    Rgb radiance = emitter.radiance;
    if (emitter.textured || emitter.has_alpha) {
        const Hit hit{emitter.instance, triangle.primitive, b.x, b.y, distance};
        const float width = std::sqrt(share * place.spread * seen.facing.share);
        radiance =
            emitted_radiance(shading, emitter, make_surface_point(shading, hit, sample.direction), {.width = width});
    }
    sample.incoming = radiance / sample.pdf;
    return sample;
}

/// 1 - cosine between unit vectors, without cancellation in narrow cones.
float versine_between(const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 chord = a - b;
    return 0.5f * glm::dot(chord, chord);
}

/// KHR_lights_punctual: linear in the cosine from the outer cone (0) to the inner one (1), then squared. If the cones
/// are equal, the edge is sharp.
float spot_falloff(const PunctualLight& light, const glm::vec3& towards_light) {
    const float inside = light.outer_versine - versine_between(light.direction, -towards_light);
    if (!(inside > 0.0f)) return 0.0f;
    const float ramp = light.outer_versine - light.inner_versine;
    const float share = inside < ramp ? inside / ramp : 1.0f;
    return share * share;
}

LightSample sample_punctual(const PunctualLight& light, const Receiver& receiver) {
    // Cosine below which a direction is parallel to the surface up to rounding. Where there is no other light, the
    // automatic exposure would turn what rounding leaves into white.
    constexpr float parallel = 1e-6f;
    LightSample sample;
    if (light.kind == Light::Kind::directional) {
        sample.direction = -light.direction;
        sample.distance = std::numeric_limits<float>::infinity();
        if (std::abs(glm::dot(receiver.normal, sample.direction)) > parallel) sample.incoming = light.intensity;
        return sample;
    }
    const glm::vec3 to_light = light.position - receiver.position;
    const float distance2 = glm::dot(to_light, to_light);
    if (!(distance2 > 0.0f)) return sample;
    const float distance = std::sqrt(distance2);
    sample.direction = to_light / distance;
    sample.distance = shadow_length(distance, largest_coordinate(light.position), any_cosine);
    float window = 1.0f;  // KHR_lights_punctual: max(min(1 - (d/range)^4, 1), 0)
    if (light.range > 0.0f) {
        const float ratio2 = distance2 / (light.range * light.range);
        window = std::clamp(1.0f - ratio2 * ratio2, 0.0f, 1.0f);
    }
    if (light.kind == Light::Kind::spot) window *= spot_falloff(light, sample.direction);
    sample.incoming = light.intensity * (window / distance2);
    return sample;
}

}  // namespace

float solid_angle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const float la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    // The volume a (b x c), without cancellation for small triangles.
    const float numerator = std::abs(glm::dot(a, glm::cross(b - a, c - a)));
    if (!(numerator > 0.0f)) return 0.0f;
    const float denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
    return 2.0f * std::atan2(numerator, denominator);
}

glm::vec3 sample_spherical_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float solid_angle,
                                    const glm::vec2& u) {
    const glm::vec3 ua = glm::normalize(a), ub = glm::normalize(b), uc = glm::normalize(c);
    // The angle at a, between the planes of the arcs to b and to c.
    const glm::vec3 ab = glm::cross(ua, ub), ac = glm::cross(ua, uc);
    const float lengths = std::sqrt(glm::dot(ab, ab) * glm::dot(ac, ac));
    if (!(lengths > 0.0f)) return ub;
    const float cos_alpha = glm::dot(ab, ac) / lengths;
    const float sin_alpha = std::abs(glm::dot(ua, glm::cross(ub - ua, uc - ua))) / lengths;
    // Cuts off a part of the triangle with the share u.x of its area; the part's third corner is on the arc from a to
    // c.
    const float area = u.x * solid_angle;
    const float sin_area = std::sin(area), cos_area = std::cos(area);
    const float s = sin_area * cos_alpha - cos_area * sin_alpha, t = cos_area * cos_alpha + sin_area * sin_alpha;
    const float k1 = t - cos_alpha;
    const float k2 = s + sin_alpha * glm::dot(ua, ub);
    const float below = (k2 * s + k1 * t) * sin_alpha;
    const float q =
        below != 0.0f ? std::clamp(((k2 * t - k1 * s) * cos_alpha - k2) / below, -1.0f, 1.0f) : glm::dot(ua, uc);
    const glm::vec3 corner = ua * q + perpendicular(uc, ua) * std::sqrt(std::max(0.0f, 1.0f - q * q));
    const float z = 1.0f - u.y * (1.0f - glm::dot(corner, ub));
    return ub * z + perpendicular(corner, ub) * std::sqrt(std::max(0.0f, 1.0f - z * z));
}

float pdf_emitter(const Emitter& emitter, const glm::vec3& position, const Hit& hit, float cosine, float distance) {
    if (!(cosine > 0.0f)) return 0.0f;
    const SeenLight seen = see_emitter(emitter, no_index, position);
    if (!(seen.facing.share > 0.0f)) return 0.0f;
    return pdf_place(emitter, seen, spread_of(emitter, hit.primitive, {hit.u, hit.v}), cosine, distance);
}

SeenLight see_light(const LightSet& lights, int light, const glm::vec3& position) {
    if (light >= std::ssize(lights.emitters)) return {light, {}, {}};
    return see_emitter(lights.emitters[light], light, position);
}

LightSample sample_seen_light(const ShadingScene& shading, const LightSet& lights, const SeenLight& seen,
                              const Receiver& receiver, const glm::vec2& u, float share) {
    const int emitters = static_cast<int>(lights.emitters.size());
    if (seen.light < emitters) {
        return sample_emitter(shading, lights.emitters[seen.light], seen, receiver.position, u, share);
    }
    const int punctual = seen.light - emitters;
    if (punctual < std::ssize(lights.punctual)) return sample_punctual(lights.punctual[punctual], receiver);
    return sample_surroundings(shading, receiver, u);
}

LightSample sample_light(const ShadingScene& shading, const LightSet& lights, int light, const Receiver& receiver,
                         const glm::vec2& u, float share) {
    return sample_seen_light(shading, lights, see_light(lights, light, receiver.position), receiver, u, share);
}

}  // namespace aleph
