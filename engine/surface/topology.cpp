#include "engine/surface/topology.h"

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <array>
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

using Options = Sdc::Options;

// OpenSubdiv's names, in the order of ours.
constexpr std::array schemes{Sdc::SCHEME_CATMARK, Sdc::SCHEME_LOOP, Sdc::SCHEME_BILINEAR};
constexpr std::array boundaries{Options::VTX_BOUNDARY_NONE, Options::VTX_BOUNDARY_EDGE_ONLY,
                                Options::VTX_BOUNDARY_EDGE_AND_CORNER};
constexpr std::array uv_rules{Options::FVAR_LINEAR_NONE,          Options::FVAR_LINEAR_CORNERS_ONLY,
                              Options::FVAR_LINEAR_CORNERS_PLUS1, Options::FVAR_LINEAR_CORNERS_PLUS2,
                              Options::FVAR_LINEAR_BOUNDARIES,    Options::FVAR_LINEAR_ALL};

float clamp_sharpness(float sharpness) {
    return std::clamp(sharpness, 0.0f, 10.0f);
}

}  // namespace

std::unique_ptr<Far::TopologyRefiner> make_refiner(const Cage& cage, std::size_t cage_points) {
    validate(cage, cage_points);
    catch_opensubdiv_messages();

    std::vector<int> crease_points;  // pairs
    std::vector<float> creases;
    for_each_crease_edge(cage, [&](int a, int b, float sharpness) {
        crease_points.insert(crease_points.end(), {a, b});
        creases.push_back(clamp_sharpness(sharpness));
    });
    std::vector<float> corners(cage.corners.sharpness.size());
    std::transform(cage.corners.sharpness.begin(), cage.corners.sharpness.end(), corners.begin(), clamp_sharpness);

    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = static_cast<int>(cage_points);
    descriptor.numFaces = static_cast<int>(cage.faces.sizes.size());
    descriptor.numVertsPerFace = cage.faces.sizes.data();
    descriptor.vertIndicesPerFace = cage.faces.points.data();
    descriptor.numCreases = static_cast<int>(creases.size());
    descriptor.creaseVertexIndexPairs = crease_points.data();
    descriptor.creaseWeights = creases.data();
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

    Options options;
    options.SetVtxBoundaryInterpolation(boundaries[index_of(cage.boundary)]);
    options.SetFVarLinearInterpolation(uv_rules[index_of(cage.uv_rule)]);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    Factory::Options factory_options(schemes[index_of(cage.scheme)], options);
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
