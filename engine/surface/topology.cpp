#include "engine/surface/topology.h"

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

#include "engine/base/errors.h"
#include "engine/surface/cage_checks.h"

namespace aleph {

namespace {

namespace Sdc = OpenSubdiv::Sdc;

// OpenSubdiv reports through a callback for the whole process, and prints where there is none.
thread_local std::string opensubdiv_error;

void catch_opensubdiv_messages() {
    static std::once_flag once;
    std::call_once(once, [] {
        Far::SetErrorCallback([](Far::ErrorType, const char* message) { opensubdiv_error = message; });
        Far::SetWarningCallback([](const char*) {});
    });
}

Sdc::SchemeType convert(Cage::Scheme scheme) {
    switch (scheme) {
        case Cage::Scheme::loop:
            return Sdc::SCHEME_LOOP;
        case Cage::Scheme::bilinear:
            return Sdc::SCHEME_BILINEAR;
        case Cage::Scheme::catmull_clark:
            break;
    }
    return Sdc::SCHEME_CATMARK;
}

Sdc::Options::VtxBoundaryInterpolation convert(Cage::Boundary boundary) {
    switch (boundary) {
        case Cage::Boundary::none:
            return Sdc::Options::VTX_BOUNDARY_NONE;
        case Cage::Boundary::edge_only:
            return Sdc::Options::VTX_BOUNDARY_EDGE_ONLY;
        case Cage::Boundary::edge_and_corner:
            break;
    }
    return Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER;
}

Sdc::Options::FVarLinearInterpolation convert(Cage::UvRule rule) {
    switch (rule) {
        case Cage::UvRule::linear_none:
            return Sdc::Options::FVAR_LINEAR_NONE;
        case Cage::UvRule::linear_corners_only:
            return Sdc::Options::FVAR_LINEAR_CORNERS_ONLY;
        case Cage::UvRule::linear_corners_plus2:
            return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS2;
        case Cage::UvRule::linear_boundaries:
            return Sdc::Options::FVAR_LINEAR_BOUNDARIES;
        case Cage::UvRule::linear_all:
            return Sdc::Options::FVAR_LINEAR_ALL;
        case Cage::UvRule::linear_corners_plus1:
            break;
    }
    return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1;
}

float clamp_sharpness(float sharpness) {
    return std::clamp(sharpness, 0.0f, 10.0f);
}

/// Crease chains as pairs of points.
struct CreaseEdges {
    std::vector<int> points;
    std::vector<float> sharpness;
};

CreaseEdges make_crease_edges(const Cage& cage) {
    CreaseEdges edges;
    for_each_crease_edge(cage, [&](int a, int b, float sharpness) {
        edges.points.insert(edges.points.end(), {a, b});
        edges.sharpness.push_back(clamp_sharpness(sharpness));
    });
    return edges;
}

}  // namespace

std::unique_ptr<Far::TopologyRefiner> make_refiner(const Cage& cage, std::size_t cage_points) {
    validate(cage, cage_points);
    catch_opensubdiv_messages();

    const CreaseEdges creases = make_crease_edges(cage);
    std::vector<float> corners(cage.corners.sharpness.size());
    std::transform(cage.corners.sharpness.begin(), cage.corners.sharpness.end(), corners.begin(), clamp_sharpness);

    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = static_cast<int>(cage_points);
    descriptor.numFaces = static_cast<int>(cage.faces.sizes.size());
    descriptor.numVertsPerFace = cage.faces.sizes.data();
    descriptor.vertIndicesPerFace = cage.faces.points.data();
    descriptor.numCreases = static_cast<int>(creases.sharpness.size());
    descriptor.creaseVertexIndexPairs = creases.points.data();
    descriptor.creaseWeights = creases.sharpness.data();
    descriptor.numCorners = static_cast<int>(corners.size());
    descriptor.cornerVertexIndices = cage.corners.points.data();
    descriptor.cornerWeights = corners.data();
    descriptor.numHoles = static_cast<int>(cage.faces.holes.size());
    descriptor.holeIndices = cage.faces.holes.data();
    Far::TopologyDescriptor::FVarChannel uv;
    if (!cage.faces.uv.empty()) {
        uv.numValues = static_cast<int>(cage.uv.size());
        uv.valueIndices = cage.faces.uv.data();
        descriptor.numFVarChannels = 1;
        descriptor.fvarChannels = &uv;
    }

    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(convert(cage.boundary));
    options.SetFVarLinearInterpolation(convert(cage.uv_rule));
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    Factory::Options factory_options(convert(cage.scheme), options);
    factory_options.validateFullTopology = true;

    opensubdiv_error.clear();
    std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(descriptor, factory_options));
    if (!refiner) {
        throw InputError("", "cage " + printable(cage.name),
                         "its faces make no surface that can be subdivided (OpenSubdiv: " +
                             printable(opensubdiv_error.empty() ? "no reason given" : opensubdiv_error, 200) + ")");
    }
    return refiner;
}

}  // namespace aleph
