#include "engine/surface/patches.h"

#include <fmt/format.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTable.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "engine/base/errors.h"
#include "engine/surface/cage_checks.h"

namespace aleph {

namespace {

// About extraordinary points the surface has no finite number of patches: in cells of 2^-deepest_isolation of an edge
// about them, one patch stands for the rest. It has the limit's position and tangents at the point; between, it slides
// along the surface by up to 1e-5 of an edge (measured by the tests). All other patches are exact.
constexpr int deepest_isolation = 9;
// Cages of many such points, or of long semi-sharp creases, are isolated less deeply, so that the number of
// control points of a pose stays at about this.
constexpr int control_point_budget = 1'000'000;

// A smooth patch at a point of n neighbours depends on all of them, so all n patches take n^2 weights. In cages more
// crowded than this the innermost patches are flat.
constexpr std::size_t max_smooth_crowding = max_crowding / 8;

Far::PatchTableFactory::Options patch_options(int isolation, bool has_uv, bool smooth_ends) {
    using Options = Far::PatchTableFactory::Options;
    Options options(static_cast<unsigned int>(isolation));
    options.SetEndCapType(smooth_ends ? Options::ENDCAP_GREGORY_BASIS : Options::ENDCAP_BILINEAR_BASIS);
    options.useInfSharpPatch = true;
    options.generateLegacySharpCornerPatches = false;
    options.generateVaryingTables = false;
    options.generateFVarTables = has_uv;
    options.generateFVarLegacyLinearPatches = false;
    options.SetPatchPrecision<double>();
    options.SetFVarPatchPrecision<double>();
    return options;
}

/// Refines as deeply as the budget allows: a function of the cage alone, so that a surface is the same at every level
/// of its triangles.
int refine(Far::TopologyRefiner& refiner, bool has_uv, bool smooth_ends) {
    constexpr int trial = 3;
    for (int level = trial;;) {
        refiner.Unrefine();
        auto options = patch_options(level, has_uv, smooth_ends).GetRefineAdaptiveOptions();
        options.orderVerticesFromFacesFirst = true;
        refiner.RefineAdaptive(options);
        // About points a level adds as many as the one before, along semi-sharp edges twice as many.
        const int points = refiner.GetNumVerticesTotal();
        if (level == deepest_isolation || points > control_point_budget / 2) return level;
        const bool is_small = points < control_point_budget >> (deepest_isolation - trial);
        level = is_small ? deepest_isolation : level + 1;
    }
}

/// Notes the weights with which OpenSubdiv makes refined points.
struct RecordedPoint {
    RefinedPoints& record;
    int index;

    void Clear() {
        record.targets.push_back(index);
        record.row_begins.push_back(static_cast<int>(record.sources.size()));
    }
    void AddWithWeight(const RecordedPoint& source, double weight) {
        if (weight == 0.0) return;
        record.sources.push_back(source.index);
        record.weights.push_back(weight);
    }
};

struct RecordedLevel {
    RefinedPoints& record;
    int first;
    RecordedPoint operator[](int i) const { return {record, first + i}; }
};

struct UvValue {
    glm::dvec2 value{0.0};

    void Clear() { value = glm::dvec2(0.0); }
    void AddWithWeight(const UvValue& source, double weight) { value += weight * source.value; }
};

/// FNV-1a, a number at a time; collisions are sorted out by comparing.
std::uint64_t hash_weights(std::span<const double> weights) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const double weight : weights) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(weight)) * 0x100000001b3u;
        hash ^= hash >> 29;
    }
    return hash;
}

/// Weighted sum of points relative to the first. With weights that add up to 0, of the points themselves.
glm::dvec3 sum_about_first(std::span<const glm::dvec3> control, const int* points, const double* weights, int count) {
    const glm::dvec3 origin = control[points[0]];
    glm::dvec3 sum(0.0);
    for (int i = 1; i < count; ++i) sum += weights[i] * (control[points[i]] - origin);
    return sum;
}

/// With weights that add up to 1: exact for equal points, accurate far from the origin.
glm::dvec3 blend(std::span<const glm::dvec3> control, const int* points, const double* weights, int count) {
    return control[points[0]] + sum_about_first(control, points, weights, count);
}

}  // namespace

LimitPatches::LimitPatches(Far::TopologyRefiner& refiner, std::size_t crowding) : refiner_(refiner) {
    const bool has_uv = refiner.GetNumFVarChannels() > 0;
    triangular_ = refiner.GetSchemeType() == OpenSubdiv::Sdc::SCHEME_LOOP;
    cage_point_count_ = refiner.GetLevel(0).GetNumVertices();
    const bool smooth_ends = crowding <= max_smooth_crowding;
    const int isolation = refine(refiner, has_uv, smooth_ends);
    table_.reset(Far::PatchTableFactory::Create(refiner, patch_options(isolation, has_uv, smooth_ends)));
    ALEPH_CHECK(table_ != nullptr, "no patch table");
    map_ = std::make_unique<Far::PatchMap>(*table_);
    record_stencils();
}

void LimitPatches::record_stencils() {
    const Far::PrimvarRefinerReal<double> primvars(refiner_);
    int first = 0;
    for (int level = 1; level < refiner_.GetNumLevels(); ++level) {
        const RecordedLevel from{refined_, first};
        first += refiner_.GetLevel(level - 1).GetNumVertices();
        RecordedLevel to{refined_, first};
        primvars.Interpolate(level, from, to);
    }
    point_count_ = refiner_.GetNumVerticesTotal();
    if (const Far::StencilTableReal<double>* local = table_->GetLocalPointStencilTable<double>()) {
        for (int i = 0; i < local->GetNumStencils(); ++i) {
            const Far::StencilReal<double> stencil = local->GetStencil(i);
            RecordedPoint point{refined_, point_count_ + i};
            point.Clear();
            for (int k = 0; k < stencil.GetSize(); ++k) {
                point.AddWithWeight({refined_, stencil.GetVertexIndices()[k]}, stencil.GetWeights()[k]);
            }
        }
        point_count_ += local->GetNumStencils();
    }
    refined_.row_begins.push_back(static_cast<int>(refined_.sources.size()));
}

std::vector<glm::dvec3> LimitPatches::make_control_points(std::span<const glm::dvec3> cage_points) const {
    ALEPH_CHECK(cage_points.size() == static_cast<std::size_t>(cage_point_count_),
                fmt::format("{} points for a cage of {}", cage_points.size(), cage_point_count_));
    std::vector<glm::dvec3> control(static_cast<std::size_t>(point_count_));
    std::copy(cage_points.begin(), cage_points.end(), control.begin());
    const auto& [targets, row_begins, sources, weights] = refined_;
    for (std::size_t row = 0; row < targets.size(); ++row) {
        const int begin = row_begins[row], count = row_begins[row + 1] - begin;
        control[targets[row]] = blend(control, &sources[begin], &weights[begin], count);
    }
    return control;
}

const Far::PatchTable::PatchHandle& LimitPatches::find_patch(int face, double& s, double& t) const {
    // FindPatch asserts on places outside.
    ALEPH_CHECK(!std::isnan(s) && !std::isnan(t), fmt::format("({}, {})", s, t));
    s = std::clamp(s, 0.0, 1.0);
    t = std::clamp(t, 0.0, triangular_ ? 1.0 - s : 1.0);
    const Far::PatchTable::PatchHandle* patch = map_->FindPatch(face, s, t);
    ALEPH_CHECK(patch != nullptr, fmt::format("no patch on face {} at ({}, {})", face, s, t));
    return *patch;
}

LimitSample LimitPatches::make_sample(const LimitLocation& location) {
    double s = location.s, t = location.t;
    const auto& patch = find_patch(location.face, s, t);
    Basis basis;
    basis.count = table_->GetPatchVertices(patch).size();
    table_->EvaluateBasis(patch, s, t, basis.weights[0], basis.weights[1], basis.weights[2]);

    LimitSample sample;
    sample.first_point =
        static_cast<int>(table_->GetPatchVertices(patch).begin() - table_->GetPatchControlVerticesTable().data());
    const std::uint64_t hash = hash_weights({basis.weights[0], 3 * max_patch_points});
    const auto [begin, end] = known_bases_.equal_range(hash);
    for (auto known = begin; known != end; ++known) {
        const Basis& other = bases_[known->second];
        if (other.count == basis.count && std::memcmp(other.weights, basis.weights, sizeof basis.weights) == 0) {
            sample.basis = known->second;
            return sample;
        }
    }
    sample.basis = static_cast<int>(bases_.size());
    bases_.push_back(basis);
    known_bases_.emplace(hash, sample.basis);
    return sample;
}

glm::dvec3 LimitPatches::position(std::span<const glm::dvec3> control, const LimitSample& sample) const {
    const Basis& basis = bases_[sample.basis];
    return blend(control, table_->GetPatchControlVerticesTable().data() + sample.first_point, basis.weights[0],
                 basis.count);
}

Tangents LimitPatches::tangents(std::span<const glm::dvec3> control, const LimitSample& sample) const {
    const Basis& basis = bases_[sample.basis];
    const int* points = table_->GetPatchControlVerticesTable().data() + sample.first_point;
    return {sum_about_first(control, points, basis.weights[1], basis.count),
            sum_about_first(control, points, basis.weights[2], basis.count)};
}

glm::dvec3 LimitPatches::evaluate(std::span<const glm::dvec3> control, int face, double s, double t,
                                  Tangents* tangents) const {
    const auto& patch = find_patch(face, s, t);
    const auto points = table_->GetPatchVertices(patch);
    double position[max_patch_points], ds[max_patch_points], dt[max_patch_points];
    table_->EvaluateBasis(patch, s, t, position, tangents ? ds : nullptr, tangents ? dt : nullptr);
    if (tangents) {
        tangents->ds = sum_about_first(control, points.begin(), ds, points.size());
        tangents->dt = sum_about_first(control, points.begin(), dt, points.size());
    }
    return blend(control, points.begin(), position, points.size());
}

std::vector<glm::vec2> LimitPatches::evaluate_uv(const std::vector<glm::vec2>& values,
                                                 const std::vector<LimitLocation>& locations) const {
    std::vector<UvValue> control(static_cast<std::size_t>(refiner_.GetNumFVarValuesTotal(0)));
    for (std::size_t i = 0; i < values.size(); ++i) control[i].value = glm::dvec2(values[i]);
    const Far::PrimvarRefinerReal<double> primvars(refiner_);
    UvValue* from = control.data();
    for (int level = 1; level < refiner_.GetNumLevels(); ++level) {
        UvValue* to = from + refiner_.GetLevel(level - 1).GetNumFVarValues(0);
        primvars.InterpolateFaceVarying(level, from, to, 0);
        from = to;
    }
    if (const auto* local = table_->GetLocalPointFaceVaryingStencilTable<double>(0)) {
        const std::size_t refined = control.size();
        control.resize(refined + static_cast<std::size_t>(local->GetNumStencils()));
        if (local->GetNumStencils() > 0) local->UpdateValues(control.data(), control.data() + refined);
    }

    std::vector<glm::vec2> result;
    result.reserve(locations.size());
    for (const LimitLocation& location : locations) {
        double s = location.s, t = location.t;
        const auto& patch = find_patch(location.face, s, t);
        const auto points = table_->GetPatchFVarValues(patch, 0);
        double weights[max_patch_points];
        table_->EvaluateBasisFaceVarying(patch, s, t, weights, static_cast<double*>(nullptr),
                                         static_cast<double*>(nullptr), static_cast<double*>(nullptr),
                                         static_cast<double*>(nullptr), static_cast<double*>(nullptr), 0);
        const glm::dvec2 origin = control[points[0]].value;
        glm::dvec2 sum(0.0);
        for (int i = 1; i < points.size(); ++i) {
            sum += weights[i] * (control[points[i]].value - origin);
        }
        result.emplace_back(origin + sum);
    }
    return result;
}

}  // namespace aleph
