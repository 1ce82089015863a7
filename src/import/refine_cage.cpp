#include "import/refine_cage.h"

#include "base/error.h"

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <memory>

namespace chiaro {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using Refiner = std::unique_ptr<Far::TopologyRefiner>;

// A texture coordinate, blended by OpenSubdiv.
struct UvPoint {
    glm::dvec2 uv = glm::dvec2(0);

    void Clear() { *this = {}; }
    void AddWithWeight(const UvPoint& other, double weight) { uv += weight * other.uv; }
};

Sdc::Options options_of(const SubdivisionRules& rules) {
    constexpr Sdc::Options::VtxBoundaryInterpolation kBoundary[] = {
        Sdc::Options::VTX_BOUNDARY_NONE, Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER,
        Sdc::Options::VTX_BOUNDARY_EDGE_ONLY};
    constexpr Sdc::Options::FVarLinearInterpolation kUvs[] = {
        Sdc::Options::FVAR_LINEAR_ALL, Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1,
        Sdc::Options::FVAR_LINEAR_NONE, Sdc::Options::FVAR_LINEAR_BOUNDARIES};
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(kBoundary[static_cast<std::size_t>(rules.boundary)]);
    options.SetFVarLinearInterpolation(kUvs[static_cast<std::size_t>(rules.uvs)]);
    options.SetCreasingMethod(rules.chaikin ? Sdc::Options::CREASE_CHAIKIN
                                            : Sdc::Options::CREASE_UNIFORM);
    return options;
}

std::vector<int> as_ints(const std::vector<std::uint32_t>& values) {
    return {values.begin(), values.end()};
}

// A topology as OpenSubdiv takes it.
struct Topology {
    std::vector<int> counts, corners, uv_corners, holes, crease_ends, sharp_vertices;
    std::vector<float> crease_sharpness, vertex_sharpness;
    int vertex_count = 0, uv_count = 0;

    void add(const SharpEdge& crease) {
        crease_ends.push_back(static_cast<int>(crease.from));
        crease_ends.push_back(static_cast<int>(crease.to));
        crease_sharpness.push_back(crease.sharpness);
    }
    void add(const SharpVertex& vertex) {
        sharp_vertices.push_back(static_cast<int>(vertex.vertex));
        vertex_sharpness.push_back(vertex.sharpness);
    }
};

Refiner make_refiner(const Topology& topology, const SubdivisionRules& rules,
                     const std::string& where) {
    // It would print what it passes over, such as creases that are no edges.
    Far::SetWarningCallback([](const char*) {});
    Far::SetErrorCallback([](Far::ErrorType, const char*) {});
    Far::TopologyDescriptor d;
    d.numVertices = topology.vertex_count;
    d.numFaces = static_cast<int>(topology.counts.size());
    d.numVertsPerFace = topology.counts.data();
    d.vertIndicesPerFace = topology.corners.data();
    d.numCreases = static_cast<int>(topology.crease_sharpness.size());
    d.creaseVertexIndexPairs = topology.crease_ends.data();
    d.creaseWeights = topology.crease_sharpness.data();
    d.numCorners = static_cast<int>(topology.vertex_sharpness.size());
    d.cornerVertexIndices = topology.sharp_vertices.data();
    d.cornerWeights = topology.vertex_sharpness.data();
    d.numHoles = static_cast<int>(topology.holes.size());
    d.holeIndices = topology.holes.data();
    Far::TopologyDescriptor::FVarChannel uvs;
    uvs.numValues = topology.uv_count;
    uvs.valueIndices = topology.uv_corners.data();
    d.numFVarChannels = topology.uv_count > 0 ? 1 : 0;
    d.fvarChannels = &uvs;

    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    Refiner refiner(Factory::Create(d, {Sdc::SCHEME_CATMARK, options_of(rules)}));
    if (!refiner) throw Error(where, "faces do not make a surface that can be subdivided");
    return refiner;
}

Topology topology_of(const Cage& cage) {
    Topology topology;
    topology.counts = as_ints(cage.corner_counts);
    topology.corners = as_ints(cage.corners);
    topology.uv_corners = as_ints(cage.uv_corners);
    topology.holes = as_ints(cage.holes);
    topology.vertex_count = static_cast<int>(cage.positions.size());
    topology.uv_count = static_cast<int>(cage.uvs.size());
    for (const SharpEdge& crease : cage.creases) topology.add(crease);
    for (const SharpVertex& vertex : cage.sharp_vertices) topology.add(vertex);
    return topology;
}

Topology topology_of(const RefinedCage& cage) {
    Topology topology;
    topology.counts.assign(cage.corners.size() / 4, 4);
    topology.corners = as_ints(cage.corners);
    topology.holes = as_ints(cage.holes);
    topology.vertex_count = static_cast<int>(cage.points.size());
    for (const SharpEdge& crease : cage.creases) topology.add(crease);
    for (const std::uint32_t vertex : cage.sharp_vertices)
        topology.add(SharpVertex{vertex, kInfinitelySharp});
    return topology;
}

std::vector<CagePoint> refined_points(const Cage& cage, const Far::TopologyRefiner& refiner) {
    const Far::PrimvarRefinerReal<double> primvars(refiner);
    std::vector<CagePoint> points(cage.positions.size());
    for (std::size_t k = 0; k < points.size(); ++k)
        points[k] = {cage.positions[k], cage.colors.empty() ? Vec4(1) : cage.colors[k]};
    for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
        std::vector<CagePoint> finer(refiner.GetLevel(level).GetNumVertices());
        primvars.Interpolate(level, points, finer);
        points = std::move(finer);
    }
    return points;
}

// At the corners of all faces of the last level, on the limit surface.
std::vector<Vec2> limit_uvs(const Cage& cage, const Far::TopologyRefiner& refiner) {
    if (cage.uvs.empty()) return {};
    const Far::PrimvarRefinerReal<double> primvars(refiner);
    std::vector<UvPoint> uvs(cage.uvs.size());
    for (std::size_t k = 0; k < uvs.size(); ++k) uvs[k].uv = cage.uvs[k];
    for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
        std::vector<UvPoint> finer(refiner.GetLevel(level).GetNumFVarValues());
        primvars.InterpolateFaceVarying(level, uvs, finer);
        uvs = std::move(finer);
    }
    std::vector<UvPoint> limit(uvs.size());
    primvars.LimitFaceVarying(uvs, limit);

    std::vector<Vec2> result;
    const Far::TopologyLevel& last = refiner.GetLevel(refiner.GetMaxLevel());
    for (int face = 0; face < last.GetNumFaces(); ++face)
        for (const int value : last.GetFaceFVarValues(face)) result.emplace_back(limit[value].uv);
    return result;
}

std::uint32_t base_face(const Far::TopologyRefiner& refiner, int face) {
    for (int level = refiner.GetMaxLevel(); level > 0; --level)
        face = refiner.GetLevel(level).GetFaceParentFace(face);
    return static_cast<std::uint32_t>(face);
}

// Rounds what sharpness the last level has left: of less than one level to none. Of three levels
// and more it differs from infinite sharpness by less than an eighth of a face.
bool stays_sharp(float sharpness, RefinedCage& refined) {
    if (sharpness > 0 && sharpness < 3) refined.rounded_much = true;
    return sharpness >= 1;
}

void copy_topology(const Far::TopologyRefiner& refiner, RefinedCage& refined) {
    const Far::TopologyLevel& last = refiner.GetLevel(refiner.GetMaxLevel());
    for (int face = 0; face < last.GetNumFaces(); ++face) {
        for (const int vertex : last.GetFaceVertices(face))
            refined.corners.push_back(static_cast<std::uint32_t>(vertex));
        refined.base_faces.push_back(base_face(refiner, face));
        if (last.IsFaceHole(face)) refined.holes.push_back(static_cast<std::uint32_t>(face));
    }
    for (int edge = 0; edge < last.GetNumEdges(); ++edge) {
        const auto ends = last.GetEdgeVertices(edge);
        // Boundaries are sharp by their rule, without a crease.
        if (!last.IsEdgeBoundary(edge) && stays_sharp(last.GetEdgeSharpness(edge), refined))
            refined.creases.push_back({static_cast<std::uint32_t>(ends[0]),
                                       static_cast<std::uint32_t>(ends[1]), kInfinitelySharp});
    }
    for (int vertex = 0; vertex < last.GetNumVertices(); ++vertex)
        if (stays_sharp(last.GetVertexSharpness(vertex), refined))
            refined.sharp_vertices.push_back(static_cast<std::uint32_t>(vertex));
}

using PatchTable = std::unique_ptr<Far::PatchTable>;

PatchTable make_patches(Far::TopologyRefiner& refiner) {
    Far::PatchTableFactory::Options options(0);  // one patch a face, without further refinement
    options.useInfSharpPatch = true;
    options.generateLegacySharpCornerPatches = false;
    options.generateVaryingTables = false;
    options.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
    options.SetPatchPrecision<double>();
    refiner.RefineAdaptive(options.GetRefineAdaptiveOptions());
    return PatchTable(Far::PatchTableFactory::Create(refiner, options));
}

// The patch's points from places and derivatives at its corners, as it is bicubic.
void from_corners(const Far::PatchTable& table, const Far::PatchTable::PatchHandle& handle,
                  const std::vector<CagePoint>& points, CagePatch& patch) {
    const auto vertices = table.GetPatchVertices(handle);
    for (int corner = 0; corner < 4; ++corner) {
        const int u = corner == 1 || corner == 2, v = corner >= 2;
        double weights[6][16];
        table.EvaluateBasis(handle, double(u), double(v), weights[0], weights[1], weights[2],
                            weights[3], weights[4], weights[5]);
        const auto sum = [&](const double* w) {
            CagePoint s;
            for (int k = 0; k < vertices.size(); ++k) s.AddWithWeight(points[vertices[k]], w[k]);
            return s;
        };
        const CagePoint p = sum(weights[0]), du = sum(weights[1]), dv = sum(weights[2]),
                        duv = sum(weights[4]);
        // Derivatives point away from the corner on its low sides, towards it on the others.
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i) {
                CagePoint& target = patch.points[4 * (v ? 3 - j : j) + (u ? 3 - i : i)];
                const double along_u = (u ? -i : i) / 3.0, along_v = (v ? -j : j) / 3.0;
                target = p;
                target.AddWithWeight(du, along_u);
                target.AddWithWeight(dv, along_v);
                target.AddWithWeight(duv, along_u * along_v);
            }
    }
}

// A Gregory patch has, for each corner: itself, its next points along both edges, and an inner
// point for each edge.
void from_gregory(const Far::PatchTable& table, const Far::PatchTable::PatchHandle& handle,
                  const std::vector<CagePoint>& points, CagePatch& patch) {
    constexpr int kPlaces[4][4] = {{0, 1, 4, 5}, {3, 7, 2, 6}, {15, 14, 11, 10}, {12, 8, 13, 9}};
    const auto vertices = table.GetPatchVertices(handle);
    check(vertices.size() == 20, "subdivision: a Gregory patch has 20 points");
    for (int corner = 0; corner < 4; ++corner) {
        const auto point = [&](int k) { return points[vertices[5 * corner + k]]; };
        const auto& [at, next, previous, inner] = kPlaces[corner];
        patch.points[at] = point(0);
        patch.points[next] = point(1);
        patch.points[previous] = point(2);
        patch.points[inner].AddWithWeight(point(3), 0.5);
        patch.points[inner].AddWithWeight(point(4), 0.5);
    }
}

}  // namespace

RefinedCage refine(const Cage& cage, int levels, const std::string& where) {
    const Refiner refiner = make_refiner(topology_of(cage), cage.rules, where);
    Far::TopologyRefiner::UniformOptions options(levels);
    options.fullTopologyInLastLevel = true;
    refiner->RefineUniform(options);
    RefinedCage refined;
    refined.rules = cage.rules;
    refined.points = refined_points(cage, *refiner);
    refined.uvs = limit_uvs(cage, *refiner);
    copy_topology(*refiner, refined);
    return refined;
}

std::vector<CagePatch> patches_of(const RefinedCage& cage, const std::string& where) {
    const Refiner refiner = make_refiner(topology_of(cage), cage.rules, where);
    const PatchTable table = make_patches(*refiner);
    std::vector<CagePoint> points = cage.points;
    points.resize(cage.points.size() + table->GetNumLocalPoints());
    if (const auto* stencils = table->GetLocalPointStencilTable<double>())
        stencils->UpdateValues(cage.points.data(), points.data() + cage.points.size());

    std::vector<CagePatch> patches;
    for (int array = 0, first = 0; array < table->GetNumPatchArrays();
         first += table->GetNumPatches(array++)) {
        const auto type = table->GetPatchArrayDescriptor(array).GetType();
        for (int k = 0; k < table->GetNumPatches(array); ++k) {
            const auto param = table->GetPatchParam(array, k);
            check(param.GetDepth() == 0, "subdivision: a face has one patch");
            CagePatch patch = {static_cast<std::uint32_t>(param.GetFaceId()),
                               type == Far::PatchDescriptor::REGULAR,
                               {}};
            Far::PatchTable::PatchHandle handle;
            handle.arrayIndex = array;
            handle.patchIndex = first + k;
            handle.vertIndex = k * table->GetPatchArrayDescriptor(array).GetNumControlVertices();
            (patch.exact ? from_corners : from_gregory)(*table, handle, points, patch);
            patches.push_back(patch);
        }
    }
    std::ranges::sort(patches, {}, &CagePatch::face);
    return patches;
}

}  // namespace chiaro
