#include "engine/alembic/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "engine/base/color.h"

namespace aleph {
namespace {

std::size_t element_count(const AlembicArchive& archive, const AlembicProperty& property, std::uint64_t sample) {
    const std::vector<std::uint64_t> sizes = archive.dimensions(property, sample);
    return std::accumulate(sizes.begin(), sizes.end(), std::size_t{1}, std::multiplies<>());
}

/// An array property of a surface with the samples that differ.
struct Sampled {
    const AlembicProperty* property = nullptr;
    AlembicSamples samples;

    std::size_t count() const { return samples.indices.size(); }
    std::size_t floor(double seconds) const {
        return count() <= 1 ? 0 : alembic_floor(samples.sampling, count(), seconds);
    }
    std::uint64_t index_at(double seconds) const { return samples.indices[floor(seconds)]; }
};

/// None where the property is missing or has no samples.
std::optional<Sampled> find_sampled(AlembicReader& reader, int object, const AlembicCompound& geom, const char* name,
                                    std::uint32_t extent) {
    const AlembicProperty* property = geom.find_sampled(name);
    if (property == nullptr) return std::nullopt;
    if (property->extent != extent)
        reader.archive.fail(object,
                            fmt::format("{} has {} values to an element, expected {}", name, property->extent, extent));
    reader.widen(*property);
    return Sampled{property, reader.archive.samples(*property)};
}

/// Every time at which points or topology have a sample; {0} where nothing changes.
std::vector<double> merge_times(const std::vector<const Sampled*>& properties) {
    std::vector<double> times;
    for (const Sampled* sampled : properties) {
        if (sampled->count() <= 1) continue;
        for (std::size_t i = 0; i < sampled->count(); ++i) times.push_back(sampled->samples.time(i));
    }
    if (times.empty()) return {0.0};
    std::ranges::sort(times);
    const auto same = [](double a, double b) { return b - a <= same_time; };
    times.erase(std::unique(times.begin(), times.end(), same), times.end());
    return times;
}

void check_topology(AlembicReader& reader, int object, SurfaceRun& run) {
    const AlembicArchive& archive = reader.archive;
    archive.budget().charge(run.face_counts.size(), sizeof(std::size_t));
    run.first_corner.reserve(run.face_counts.size());
    std::size_t corners = 0;
    for (std::size_t face = 0; face < run.face_counts.size(); ++face) {
        const int count = run.face_counts[face];
        if (count < 0 || static_cast<std::size_t>(count) > run.face_points.size() - corners) {
            archive.fail(object, fmt::format("face {} claims {} points, {} are left", face, count,
                                             run.face_points.size() - corners));
        }
        run.first_corner.push_back(corners);
        corners += static_cast<std::size_t>(count);
    }
    if (corners != run.face_points.size()) {
        archive.fail(object, fmt::format("its faces take {} points, {} are given", corners, run.face_points.size()));
    }
    for (const int point : run.face_points) {
        if (point < 0 || static_cast<std::size_t>(point) >= run.point_count)
            archive.fail(object, fmt::format("a face asks for point {}, there are {}", point, run.point_count));
    }
}

std::vector<glm::vec3> read_vectors(const AlembicArchive& archive, const AlembicProperty& property,
                                    std::uint64_t sample) {
    const std::vector<float> values = archive.numbers<float>(property, sample);
    std::vector<glm::vec3> vectors(values.size() / 3);
    archive.budget().charge(vectors.size(), sizeof(glm::vec3));
    for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return vectors;
}

void read_point_cache(AlembicReader& reader, int object, const Sampled& points, SurfaceRun& run) {
    const AlembicArchive& archive = reader.archive;
    PointCache cache;
    cache.name = archive.path(object);
    cache.sampling = run.sampling;
    for (const std::uint64_t sample : run.point_samples) {
        cache.positions.push_back(read_vectors(archive, *points.property, sample));
        for (std::size_t i = 0; i < run.point_count; ++i) {
            if (!is_finite(cache.positions.back()[i]))
                archive.fail(object, fmt::format("point {} of sample {} is not finite", i, sample));
        }
    }
    run.points = append(reader.part.point_caches, std::move(cache));
}

/// A run is shown from its begin to that of the next one.
Track<double> make_presence(const std::vector<SurfaceRun>& runs, std::size_t run) {
    Track<double> track({}, {}, Interpolation::step);
    const auto add = [&](double time, double value) {
        track.sampling.times.push_back(time);
        track.values.push_back(value);
    };
    // As alembic_floor finds samples.
    if (run > 0) add(runs.front().begin - same_time, 0.0);
    add(runs[run].begin - same_time, 1.0);
    if (run + 1 < runs.size()) add(runs[run + 1].begin - same_time, 0.0);
    return track;
}

/// One topology of a surface as stored, with the blocks that hold it.
struct Topology {
    std::vector<int> face_counts, face_points;
    std::uint64_t counts_block = 0, indices_block = 0;
};

/// Makes runs of a surface's samples, each with its topology and the samples of its points.
class RunSplitter {
  public:
    RunSplitter(AlembicReader& reader, int object, Sampled points, Sampled counts, Sampled indices)
        : reader_(reader),
          object_(object),
          points_(std::move(points)),
          counts_(std::move(counts)),
          indices_(std::move(indices)) {}

    std::vector<SurfaceRun> split() {
        for (const double time : merge_times({&points_, &counts_, &indices_})) add(time);
        for (SurfaceRun& run : runs_) run.sampling.kind = TimeSampling::Kind::acyclic;
        const AlembicSamples& points = points_.samples;
        if (runs_.size() == 1 && runs_.front().point_samples == points.indices)
            runs_.front().sampling = points.sampling;  // as the file has it
        return std::move(runs_);
    }

  private:
    void add(double time) {
        const AlembicArchive& archive = reader_.archive;
        const std::size_t at = points_.floor(time);
        const std::uint64_t point_sample = points_.samples.indices[at];
        const std::size_t point_count = element_count(archive, *points_.property, point_sample);
        // Sparse files leave points out where they do not change.
        const bool has_faces = element_count(archive, *indices_.property, indices_.index_at(time)) > 0;
        if (point_count == 0 && has_faces) return;
        if (changes_topology(time, point_count)) {
            SurfaceRun run;
            run.begin = time;
            run.point_count = point_count;
            run.face_counts = std::move(next_.face_counts);
            run.face_points = std::move(next_.face_points);
            check_topology(reader_, object_, run);
            archive.budget().charge(1, 1024);
            runs_.push_back(std::move(run));
        } else if (at == last_point_sample_) {
            return;
        }
        last_point_sample_ = at;
        runs_.back().point_samples.push_back(point_sample);
        runs_.back().sampling.times.push_back(time);
    }

    /// True where the topology at a time differs from that of the last run; it is in next_ then. Samples that share
    /// their storage are not read again.
    bool changes_topology(double time, std::size_t point_count) {
        const AlembicArchive& archive = reader_.archive;
        const std::uint64_t counts_sample = counts_.index_at(time);
        const std::uint64_t indices_sample = indices_.index_at(time);
        const std::uint64_t counts_block = archive.storage(*counts_.property, counts_sample);
        const std::uint64_t indices_block = archive.storage(*indices_.property, indices_sample);
        const bool same_points = !runs_.empty() && runs_.back().point_count == point_count;
        if (same_points && counts_block == next_.counts_block && indices_block == next_.indices_block) return false;
        next_ = {archive.numbers<int>(*counts_.property, counts_sample),
                 archive.numbers<int>(*indices_.property, indices_sample), counts_block, indices_block};
        return !same_points || next_.face_counts != runs_.back().face_counts ||
               next_.face_points != runs_.back().face_points;
    }

    AlembicReader& reader_;
    int object_;
    const Sampled points_, counts_, indices_;
    std::vector<SurfaceRun> runs_;
    Topology next_;  ///< read last
    std::size_t last_point_sample_ = 0;
};

}  // namespace

std::vector<SurfaceRun> read_runs(AlembicReader& reader, int object, const AlembicCompound& geom) {
    const auto points = find_sampled(reader, object, geom, "P", 3);
    const auto counts = find_sampled(reader, object, geom, ".faceCounts", 1);
    const auto indices = find_sampled(reader, object, geom, ".faceIndices", 1);
    if (!points || !counts || !indices) {
        reader.warn(object, "a surface without points or faces");
        return {};
    }
    std::vector<SurfaceRun> runs = RunSplitter(reader, object, *points, *counts, *indices).split();
    if (runs.size() > 1) {
        reader.warn(object,
                    fmt::format("its topology changes {} times: there is no motion across a change", runs.size() - 1));
        for (std::size_t i = 0; i < runs.size(); ++i) runs[i].present = make_presence(runs, i);
    }
    std::erase_if(runs, [](const SurfaceRun& run) { return run.face_points.empty(); });
    for (SurfaceRun& run : runs) read_point_cache(reader, object, *points, run);
    return runs;
}

std::uint64_t sample_at(const AlembicArchive& archive, const AlembicProperty& property, double seconds) {
    if (property.is_constant()) return 0;
    const TimeSampling& sampling = archive.time_samplings()[property.time_sampling];
    std::size_t count = property.sample_count;
    if (sampling.kind == TimeSampling::Kind::acyclic) count = std::min(count, sampling.times.size());
    return alembic_floor(sampling, count, seconds);
}

SurfaceParts read_parts(AlembicReader& reader, int object, const AlembicCompound& top, const SurfaceRun& run) {
    const AlembicArchive& archive = reader.archive;
    const std::string own = read_text(reader, top, ".material.assign");
    std::vector<int> face_materials(run.face_counts.size(),
                                    own.empty() ? no_index : read_material(reader, object, own));
    for (const int child : archive.objects()[object].children) {
        if (archive.objects()[child].schema() != "AbcGeom_FaceSet_v1") continue;
        const AlembicCompound child_top = archive.properties(child);
        const std::string assigned = read_text(reader, child_top, ".material.assign");
        if (assigned.empty()) continue;
        const AlembicCompound face_set = archive.properties(child_top, ".faceset");
        const AlembicProperty* faces = face_set.find_sampled(".faces");
        if (faces == nullptr) continue;
        if (!faces->is_constant())
            reader.warn(child, "the face set changes over time; its first state is used until the topology changes");
        const int material = read_material(reader, child, assigned);
        for (const int face : archive.numbers<int>(*faces, sample_at(archive, *faces, run.begin))) {
            if (face < 0 || face >= std::ssize(face_materials)) {
                reader.warn(child, "the face set names faces that the surface does not have");
                continue;
            }
            face_materials[face] = material;
        }
    }
    SurfaceParts parts;
    parts.face_parts.reserve(face_materials.size());
    for (std::size_t face = 0; face < face_materials.size(); ++face) {
        if (run.face_counts[face] < 3) {  // not drawn, so it needs no part
            parts.face_parts.push_back(0);
            continue;
        }
        const int material = face_materials[face] == no_index ? neutral_material(reader) : face_materials[face];
        const auto found = std::ranges::find(parts.materials, material);
        parts.face_parts.push_back(static_cast<int>(found - parts.materials.begin()));
        if (found == parts.materials.end()) parts.materials.push_back(material);
    }
    return parts;
}

}  // namespace aleph
