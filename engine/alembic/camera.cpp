#include "engine/alembic/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/alembic/reader.h"

namespace aleph {
namespace {

constexpr double mm_per_cm = 10.0;

/// The numbers that Camera needs: radians, heights of the picture, scene units.
struct View {
    double fov, shift_x, shift_y, focus;
};

View make_view(std::span<const double> core, const glm::dmat3& film_back) {
    const FilmWindow window = film_window(core, film_back);
    const double height = window.top - window.bottom;
    const double half_width_tangent = core[horizontal_aperture] * mm_per_cm / (2.0 * core[focal_length]);
    return {2.0 * std::atan(0.5 * height * half_width_tangent), 0.5 * (window.left + window.right) / height,
            0.5 * (window.bottom + window.top) / height, core[focus_distance]};
}

/// A track over all samples; what never changes is one value.
Track<double> make_track(const AlembicSamples& samples, const std::vector<View>& views, double View::*member) {
    Track<double> track;
    for (const View& view : views) track.values.push_back(view.*member);
    const double first = track.values.front();
    if (std::ranges::all_of(track.values, [&](double value) { return value == first; })) return first;
    track.sampling = samples.sampling;
    return track;
}

/// An archive interpolates focal length and aperture linearly; the angle that they give is not linear in time. Cubic
/// keys at quarters of every interval, with the slopes of the exact curve (one sided at samples, where it bends), stay
/// within 1e-7 rad of it.
Track<double> make_fov_track(const AlembicSamples& samples, const std::vector<std::vector<double>>& cores,
                             const std::vector<View>& views, const glm::dmat3& film_back) {
    Track<double> track = make_track(samples, views, &View::fov);
    if (track.values.size() == 1) return track;
    constexpr int pieces = 4;
    constexpr double step = 1e-4;  // of an interval
    track = Track<double>({}, {}, Interpolation::cubic);
    double arriving = 0.0;
    for (std::size_t i = 0; i + 1 < cores.size(); ++i) {
        const double begin = samples.time(i), interval = samples.time(i + 1) - begin;
        const auto fov_at = [&](double fraction) {
            std::vector<double> core = cores[i];
            for (std::size_t k = 0; k < core.size(); ++k) core[k] += fraction * (cores[i + 1][k] - core[k]);
            return make_view(core, film_back).fov;
        };
        const auto slope_at = [&](double fraction) {  // three points: at the ends from within
            if (fraction == 0.0) return (4.0 * fov_at(step) - 3.0 * fov_at(0.0) - fov_at(2.0 * step)) / (2.0 * step);
            if (fraction == 1.0)
                return (3.0 * fov_at(1.0) - 4.0 * fov_at(1.0 - step) + fov_at(1.0 - 2.0 * step)) / (2.0 * step);
            return (fov_at(fraction + step) - fov_at(fraction - step)) / (2.0 * step);
        };
        for (int piece = 0; piece < pieces; ++piece) {
            const double fraction = static_cast<double>(piece) / pieces;
            const double slope = slope_at(fraction) / interval;
            track.sampling.times.push_back(begin + fraction * interval);
            const double value = piece == 0 ? views[i].fov : fov_at(fraction);
            for (const double number : {piece == 0 ? arriving : slope, value, slope}) track.values.push_back(number);
        }
        arriving = slope_at(1.0) / interval;
    }
    track.sampling.times.push_back(samples.time(cores.size() - 1));
    for (const double number : {arriving, views.back().fov, 0.0}) track.values.push_back(number);
    return track;
}

glm::dmat3 read_film_back(AlembicReader& reader, int object, const AlembicCompound& geom) {
    const AlembicProperty* operations = geom.find_sampled(".filmBackOps");
    const AlembicProperty* channels = geom.find_sampled(".filmBackChannels");
    if (operations == nullptr) return glm::dmat3(1.0);
    if (channels != nullptr && !channels->is_constant())
        reader.warn(object, "its film back changes over time; its first state is used");
    try {
        std::vector<double> values;
        if (channels != nullptr) values = reader.archive.numbers<double>(*channels, 0);
        return film_back_matrix(reader.archive.texts(*operations, 0), values);
    } catch (const std::invalid_argument& error) {
        reader.archive.fail(object, error.what());
    }
}

}  // namespace

FilmWindow film_window(std::span<const double> core, const glm::dmat3& film_back) {
    const double width = core[horizontal_aperture], squeeze = core[lens_squeeze];
    const double half_height = squeeze * core[vertical_aperture] / width;
    const auto place = [&](double x, double y) {
        const glm::dvec3 p = film_back * glm::dvec3(x, y, 1.0);
        return glm::dvec2(p.x / p.z, p.y / p.z);
    };
    const glm::dvec2 first = place(-squeeze, half_height);
    const glm::dvec2 second = place(squeeze, -half_height);
    const double move_x = 2.0 * core[horizontal_offset] * squeeze / width, move_y = 2.0 * core[vertical_offset] / width;
    return {first.x + move_x, second.x + move_x, second.y + move_y, first.y + move_y};
}

glm::dmat3 film_back_matrix(const std::vector<std::string>& operations, std::span<const double> channels) {
    glm::dmat3 result(1.0);
    for (const std::string& operation : operations) {
        const char kind = operation.empty() ? '\0' : operation.front();
        const std::size_t count = kind == 'm' ? 9 : kind == 't' || kind == 's' ? 2 : 0;
        if (count == 0) throw std::invalid_argument("its film back has an operation of an unknown kind");
        if (count > channels.size()) throw std::invalid_argument("its film back has fewer channels than it needs");
        glm::dmat3 m(1.0);
        if (kind == 't') m[2] = {channels[0], channels[1], 1.0};
        if (kind == 's') m[0][0] = channels[0], m[1][1] = channels[1];
        if (kind == 'm') {
            for (int i = 0; i < 9; ++i) m[i / 3][i % 3] = channels[i];
        }
        channels = channels.subspan(count);
        result = result * m;  // as with transforms: the last acts first
    }
    return result;
}

int read_camera(AlembicReader& reader, int object, const AlembicCompound& top) {
    const AlembicArchive& archive = reader.archive;
    if (const auto known = reader.camera_of.find(object); known != reader.camera_of.end()) return known->second;
    const AlembicCompound geom = archive.properties(top, ".geom");
    const AlembicProperty* property = geom.find_sampled(".core");
    if (property == nullptr) archive.fail(object, "the camera has no .core");
    if (property->extent != camera_channel_count) {
        archive.fail(object, fmt::format("the camera has {} numbers, expected {}", property->extent,
                                         static_cast<int>(camera_channel_count)));
    }
    const glm::dmat3 film_back = read_film_back(reader, object, geom);
    const AlembicSamples samples = archive.samples(*property);
    std::vector<std::vector<double>> cores;
    std::vector<View> views;
    for (const std::uint64_t index : samples.indices) {
        cores.push_back(archive.numbers<double>(*property, index));
        const std::vector<double>& core = cores.back();
        for (const AlembicCameraChannel channel : {focal_length, horizontal_aperture, vertical_aperture, lens_squeeze})
            if (!(core[channel] > 0.0)) archive.fail(object, "the camera's lens and film must have positive sizes");
        views.push_back(make_view(core, film_back));
        const View& view = views.back();
        if (!(view.fov > 0.0) || !std::isfinite(view.fov) || !std::isfinite(view.shift_x) ||
            !std::isfinite(view.shift_y) || !std::isfinite(view.focus)) {
            archive.fail(object, "the camera's numbers give no field of view");
        }
    }
    reader.widen(*property);

    Camera camera{.name = archive.objects()[object].name,
                  .fov = make_fov_track(samples, cores, views, film_back),
                  .shift_x = make_track(samples, views, &View::shift_x),
                  .shift_y = make_track(samples, views, &View::shift_y),
                  .focus_distance = make_track(samples, views, &View::focus)};
    const std::vector<double>& first = cores.front();
    if (first[near_plane] > 0.0 && std::isfinite(first[near_plane])) camera.near_plane = first[near_plane];
    reader.warn(object, "the camera's f-stop and shutter are not used: everything is in focus and nothing blurs");
    for (const AlembicCameraChannel channel : {overscan_left, overscan_right, overscan_top, overscan_bottom}) {
        if (first[channel] == 0.0) continue;
        reader.warn(object, "the camera's overscan is not used: the picture shows the film's frame");
        break;
    }
    return reader.camera_of[object] = append(reader.part.cameras, std::move(camera));
}

}  // namespace aleph
