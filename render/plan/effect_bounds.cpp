#include "render/plan/effect_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace aleph {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr std::size_t most_objects = 128;  // of which all pairs are looked at
constexpr std::size_t most_tests = 1000000;

double distance_to(const Bounds& box, const glm::dvec3& point) {
    return glm::length(glm::max(glm::max(box.low - point, point - box.high), glm::dvec3(0.0)));
}

/// A sphere around a box, m.
struct Sphere {
    glm::dvec3 center;
    double radius;
};

Sphere sphere_around(const Bounds& box) {
    const glm::dvec3 center = 0.5 * (box.low + box.high);
    return {center, glm::length(box.high - center)};
}

bool overlap(const Bounds& a, const Bounds& b) {
    return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
}

/// Whether all of a box lies in the plane of a flat object.
bool is_in_plane(const ObjectFacts& flat, const Bounds& box) {
    const double slack = 1e-6 * (glm::length(box.high - box.low) + glm::length(flat.bounds.high - flat.bounds.low));
    for (int i = 0; i < 8; ++i) {
        if (std::abs(glm::dot(flat.normal, box.corner(i) - flat.point)) > slack) return false;
    }
    return true;
}

/// Share of its illuminance that a surface of `receiver` can have from what lies in `other`.
double largest_view(const ObjectFacts& receiver, const ObjectFacts& other) {
    if (&receiver == &other) return receiver.convex ? 0.0 : 1.0;
    if (receiver.flat && is_in_plane(receiver, other.bounds)) return 0.0;
    const Sphere sphere = sphere_around(other.bounds);
    const double distance = distance_to(receiver.bounds, sphere.center);
    return distance > sphere.radius ? sphere.radius * sphere.radius / (distance * distance) : 1.0;
}

struct Interval {
    double low = unbounded, high = -unbounded;
    bool meets(const Interval& o) const { return low <= o.high && o.low <= high; }
};

Interval along(const Bounds& box, const glm::dvec3& axis) {
    Interval interval;
    for (int i = 0; i < 8; ++i) {
        const double at = glm::dot(axis, box.corner(i));
        interval.low = std::min(interval.low, at);
        interval.high = std::max(interval.high, at);
    }
    return interval;
}

/// Whether parallel light that comes to one box may meet another before it.
bool may_block_parallel(const Bounds& receiver, const Bounds& blocker, const glm::dvec3& towards_light) {
    if (along(blocker, towards_light).high < along(receiver, towards_light).low) return false;
    const glm::dvec3 other = std::abs(towards_light.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 across = glm::normalize(glm::cross(towards_light, other));
    return along(receiver, across).meets(along(blocker, across)) &&
           along(receiver, glm::cross(towards_light, across)).meets(along(blocker, glm::cross(towards_light, across)));
}

bool may_block(const LightFacts& light, const ObjectFacts& receiver, const ObjectFacts& blocker) {
    switch (light.kind) {
        case LightFacts::Kind::surroundings:
            return !(receiver.flat && is_in_plane(receiver, blocker.bounds));
        case LightFacts::Kind::directional:
            return may_block_parallel(receiver.bounds, blocker.bounds, -light.direction);
        case LightFacts::Kind::surface:
        case LightFacts::Kind::point:
            break;
    }
    Bounds hull = receiver.bounds;
    hull.add(light.center - light.radius);
    hull.add(light.center + light.radius);
    return overlap(hull, blocker.bounds);
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

/// The most that 1 + albedo + albedo^2 + ... can be, from power `first` to `last`.
double sum_powers(double albedo, int first, int last) {
    double sum = 0.0, power = std::pow(albedo, first);
    for (int k = first; k <= last && sum < 1e12 && power > 1e-18; ++k, power *= albedo) sum += power;
    return sum;
}

/// Radiance that a ray can meet, without the highlights of lights that have no area.
double largest_radiance(const FrameFacts& facts, int bounces) {
    double shines = 0.0, around = 0.0;
    for (const ObjectFacts& object : facts.objects) shines = std::max(shines, double{object.material.radiance});
    for (const LightFacts& light : facts.lights) {
        if (light.kind == LightFacts::Kind::surroundings) around = light.strength;
    }
    const double lit = largest_direct_radiance(facts);
    return (shines + around + lit) * (1.0 + sum_powers(largest_diffuse(facts), 1, bounces));
}

/// Largest f cos of the lobes that have a width, 1/sr: F D G2 / (4 n.v) at its peak.
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

}  // namespace

double largest_illuminance(const LightFacts& light, const Bounds& box) {
    switch (light.kind) {
        case LightFacts::Kind::surroundings:
            return pi * light.strength;
        case LightFacts::Kind::directional:
            return light.strength;
        case LightFacts::Kind::point: {
            const double distance = distance_to(box, light.center);
            if (light.range > 0.0 && distance > light.range) return 0.0;
            return distance > 0.0 ? light.strength / (distance * distance) : unbounded;
        }
        case LightFacts::Kind::surface:
            break;
    }
    const double distance = distance_to(box, light.center);
    const double share = distance > light.radius ? light.radius * light.radius / (distance * distance) : 1.0;
    return pi * light.strength * share;
}

void bound_direct_light(FrameFacts& facts) {
    Bounds all;
    for (const ObjectFacts& object : facts.objects) {
        all.add(object.bounds.low);
        all.add(object.bounds.high);
    }
    const bool one_by_one = facts.objects.size() * facts.lights.size() <= most_tests / 10;
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

bool may_be_shadowed(const FrameFacts& facts, const LightFacts& light) {
    const std::size_t count = facts.objects.size();
    if (count * count * facts.lights.size() > most_tests) return true;
    const ObjectFacts* const lamp = light.object == no_index ? nullptr : &facts.objects[light.object];
    for (const ObjectFacts& receiver : facts.objects) {
        if (!receiver.material.scatters()) continue;
        if (!receiver.convex || receiver.material.alpha) return true;
        const bool near = light.kind == LightFacts::Kind::point && distance_to(receiver.bounds, light.center) == 0.0;
        if (near || (receiver.material.glass && !receiver.flat)) return true;  // a lamp within a body
        for (const ObjectFacts& blocker : facts.objects) {
            const bool itself = &blocker == &receiver || (&blocker == lamp && lamp->convex);
            if (!itself && &receiver != lamp && may_block(light, receiver, blocker)) return true;
            if (&receiver == lamp && &blocker != lamp && may_block(light, receiver, blocker)) return true;
        }
    }
    return false;
}

double bound_indirect_light(const FrameFacts& facts, int bounces) {
    if (facts.objects.size() > most_objects) return unbounded;
    const double again = sum_powers(largest_diffuse(facts), 1, bounces - 1);
    const double further = again > 0.0 ? again * largest_direct_radiance(facts) : 0.0;
    const double met = largest_radiance(facts, bounces);
    std::vector<double> sent;
    for (const ObjectFacts& object : facts.objects) {
        double radiance = object.material.diffuse > 0.0f ? object.lit_radiance + further : 0.0;
        if (object.material.has_specular()) {
            const double share = object.material.glass ? 1.0 : object.material.reflectance;
            radiance += share * met + largest_highlight(facts, object);
        }
        sent.push_back(radiance);
    }
    double largest = 0.0;
    for (const ObjectFacts& receiver : facts.objects) {
        if (!(receiver.material.diffuse > 0.0f) || !facts.is_seen(receiver)) continue;
        double received = 0.0;
        for (std::size_t i = 0; i < facts.objects.size(); ++i) {
            const double view = sent[i] > 0.0 ? largest_view(receiver, facts.objects[i]) : 0.0;
            if (view > 0.0) received += view * sent[i];
        }
        largest = std::max(largest, receiver.material.diffuse * received);
    }
    return largest;
}

double bound_further_bounces(const FrameFacts& facts, int bounces, int most) {
    const double powers = sum_powers(largest_diffuse(facts), bounces + 1, most);
    if (!(powers > 0.0)) return 0.0;
    const bool specular =
        std::ranges::any_of(facts.objects, [](const ObjectFacts& o) { return o.material.has_specular(); });
    return powers * (specular ? largest_radiance(facts, most) : largest_direct_radiance(facts));
}

double bound_glossy_light(const FrameFacts& facts, int bounces) {
    const double met = largest_radiance(facts, bounces);
    double largest = 0.0;
    for (const ObjectFacts& object : facts.objects) {
        if (!object.material.glossy) continue;
        largest = std::max(largest, object.material.reflectance * met + largest_highlight(facts, object));
    }
    return largest > 0.0 ? largest * (1.0 + bounces) : 0.0;
}

double bound_light(const FrameFacts& facts, const LightFacts& light, int bounces) {
    double largest = 0.0;
    for (const ObjectFacts& object : facts.objects) {
        if (light.object != no_index && &facts.objects[light.object] == &object && object.convex) continue;
        double reflects = object.material.diffuse / pi;
        if (object.material.has_specular() && !light.has_area()) reflects += lobe_peak(object.material);
        if (object.material.glass && !light.has_area()) return unbounded;
        if (reflects > 0.0) largest = std::max(largest, reflects * largest_illuminance(light, object.bounds));
    }
    return largest > 0.0 ? largest * (1.0 + bounces) : 0.0;
}

double bound_blur(const BlurMoments& blur, PixelFilter filter) {
    // Slope and curvature behind the filter of a picture between 0 and 1, along a line: of an edge, per pixel.
    const bool smooth = filter == PixelFilter::blackman_harris;
    const double slope = smooth ? 0.93 : 1.0;
    const double first = slope * blur.mean;
    if (!smooth) return std::min(1.0, first);
    constexpr double curvature = 2.7;
    return std::min({1.0, first, slope * blur.shift + 0.5 * curvature * blur.mean_square});
}

}  // namespace aleph
