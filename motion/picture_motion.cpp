#include "motion/picture_motion.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "engine/base/pixel_loops.h"

namespace aleph {
namespace {

/// Between the four pixels around a place whose pixel centres are whole numbers; the nearest ones at the border.
glm::dvec2 interpolate(const Image<glm::dvec2>& field, const glm::dvec2& place) {
    const glm::dvec2 at = glm::clamp(place, glm::dvec2(0.0), glm::dvec2(field.width - 1, field.height - 1));
    const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
    const int right = std::min(x + 1, field.width - 1), below = std::min(y + 1, field.height - 1);
    return glm::mix(glm::mix(field(x, y), field(right, y), at.x - x),
                    glm::mix(field(x, below), field(right, below), at.x - x), at.y - y);
}

/// @param way   of the pixel
/// @param back  of all pixels of the other picture
MotionValidity check(int x, int y, const glm::dvec2& way, const Image<glm::dvec2>& back) {
    const glm::dvec2 place = glm::dvec2(x, y) + way;
    if (!(place.x >= -0.5 && place.y >= -0.5 && place.x <= back.width - 0.5 && place.y <= back.height - 0.5))
        return MotionValidity::leaves_screen;
    const glm::dvec2 returned = interpolate(back, place), rest = way + returned;
    const double tolerance = 0.01 * (glm::dot(way, way) + glm::dot(returned, returned)) + 0.5;
    return glm::dot(rest, rest) <= tolerance ? MotionValidity::valid : MotionValidity::no_counterpart;
}

MotionField make_checked(const Image<glm::dvec2>& ways, const Image<glm::dvec2>& back) {
    MotionField field = make_motion_field(ways.width, ways.height, MotionValidity::no_counterpart);
    const double longest = std::hypot(ways.width, ways.height);
    parallel_pixels(ways, 8, [&](int x, int y) {
        const MotionValidity validity = check(x, y, ways(x, y), back);
        field.validity(x, y) = validity;
        if (validity == MotionValidity::no_counterpart) return;
        const double length = glm::length(ways(x, y));
        field.path_length(x, y) = std::min(length, longest);
        field.displacement(x, y) = length > longest ? ways(x, y) * (longest / length) : ways(x, y);
    });
    return field;
}

}  // namespace

SearchedPicture prepare_picture(const Image<Rgb>& picture, PictureSearch search) {
    SearchedPicture prepared;
    if (search == PictureSearch::flow) {
        prepared.grey = make_flow_picture(picture);
    } else {
        prepared.census = make_census_pyramid(picture);
    }
    return prepared;
}

MotionField compute_picture_motion(const SearchedPicture& first, const SearchedPicture& second, PictureSearch search) {
    if (search == PictureSearch::census) return compute_image_motion(first.census, second.census);
    return compute_picture_motions(first, second, search).there;
}

PictureMotions compute_picture_motions(const SearchedPicture& first, const SearchedPicture& second,
                                       PictureSearch search) {
    if (search == PictureSearch::flow) {
        const FlowPair ways = compute_flow(first.grey, second.grey);
        return {make_checked(ways.there, ways.back), make_checked(ways.back, ways.there)};
    }
    PictureMotions found{compute_image_motion(first.census, second.census),
                         compute_image_motion(second.census, first.census)};
    if (search == PictureSearch::census) return found;
    return {make_checked(found.there.displacement, found.back.displacement),
            make_checked(found.back.displacement, found.there.displacement)};
}

void turn_round(MotionField& field) {
    for (glm::dvec2& displacement : field.displacement.pixels) displacement = glm::dvec2(0.0) - displacement;
}

}  // namespace aleph
