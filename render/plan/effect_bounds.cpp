#include "render/plan/effect_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aleph {

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t most_lit = 100000;  // pairs of objects and lights that are looked at one by one

}  // namespace

double distance_to(const Bounds& box, const glm::dvec3& point) {
    return glm::length(glm::max(glm::max(box.low - point, point - box.high), glm::dvec3(0.0)));
}

bool is_in_plane(const ObjectFacts& flat, const Bounds& box) {
    const double slack = 1e-6 * (glm::length(box.high - box.low) + glm::length(flat.bounds.high - flat.bounds.low));
    for (int i = 0; i < 8; ++i) {
        if (std::abs(glm::dot(flat.normal, box.corner(i) - flat.point)) > slack) return false;
    }
    return true;
}

double largest_illuminance(const LightFacts& light, const Bounds& box) {
    if (light.kind == LightFacts::Kind::surroundings) return pi * light.strength;
    if (light.kind == LightFacts::Kind::directional) return light.strength;
    const double distance = distance_to(box, light.center);
    if (light.kind == LightFacts::Kind::point) {
        if (light.range > 0.0 && distance > light.range) return 0.0;
        return distance > 0.0 ? light.strength / (distance * distance) : unbounded;
    }
    const double share = distance > light.radius ? light.radius * light.radius / (distance * distance) : 1.0;
    return pi * light.strength * share;
}

void bound_direct_light(FrameFacts& facts) {
    Bounds all;
    for (const ObjectFacts& object : facts.objects) {
        all.add(object.bounds.low);
        all.add(object.bounds.high);
    }
    const bool one_by_one = facts.objects.size() * facts.lights.size() <= most_lit;
    double everywhere = 0.0;
    if (!one_by_one) {
        for (const LightFacts& light : facts.lights) everywhere += largest_illuminance(light, all);
    }
    for (std::size_t i = 0; i < facts.objects.size(); ++i) {
        ObjectFacts& object = facts.objects[i];
        if (!(object.material.diffuse > 0.0f)) continue;
        double illuminance = everywhere;
        for (const LightFacts& light : facts.lights) {
            if (!one_by_one) break;
            const bool own = light.object == static_cast<int>(i) && object.convex;
            if (!own) illuminance += largest_illuminance(light, object.bounds);
        }
        object.lit_radiance = object.material.diffuse / pi * illuminance;
    }
}

double largest_diffuse(const FrameFacts& facts) {
    double largest = 0.0;
    for (const ObjectFacts& object : facts.objects) largest = std::max(largest, double{object.material.diffuse});
    return largest;
}

double largest_direct_radiance(const FrameFacts& facts) {
    double largest = 0.0;
    for (const ObjectFacts& object : facts.objects) largest = std::max(largest, object.lit_radiance);
    return largest;
}

double sum_powers(double albedo, int first, int last) {
    double sum = 0.0, power = std::pow(albedo, first);
    for (int k = first; k <= last && sum < 1e12 && power > 1e-18; ++k, power *= albedo) sum += power;
    return sum;
}

double largest_radiance(const FrameFacts& facts, int bounces) {
    double shines = 0.0, around = 0.0;
    for (const ObjectFacts& object : facts.objects) shines = std::max(shines, double{object.material.radiance});
    for (const LightFacts& light : facts.lights) {
        if (light.kind == LightFacts::Kind::surroundings) around = light.strength;
    }
    const double lit = largest_direct_radiance(facts);
    return (shines + around + lit) * (1.0 + sum_powers(largest_diffuse(facts), 1, bounces));
}

double lobe_peak(const MaterialFacts& material) {
    const double width = material.least_width;
    return material.reflectance / (pi * width * width) * 0.5 / width;
}

double largest_highlight(const FrameFacts& facts, const ObjectFacts& object) {
    double illuminance = 0.0;
    for (const LightFacts& light : facts.lights) {
        if (!light.has_area()) illuminance += largest_illuminance(light, object.bounds);
    }
    return illuminance > 0.0 ? illuminance * lobe_peak(object.material) : 0.0;
}

}  // namespace aleph
