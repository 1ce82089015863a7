// Refinement of cages, and the bicubic pieces of refined ones: all that knows of OpenSubdiv.
#pragma once

#include "import/cage.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace chiaro {

/// A vertex with its colour, blended by OpenSubdiv.
struct CagePoint {
    glm::dvec3 place = glm::dvec3(0);
    glm::dvec4 color = glm::dvec4(0);

    void Clear() { *this = {}; }
    void AddWithWeight(const CagePoint& other, double weight) {
        place += weight * other.place;
        color += weight * other.color;
    }
};

/// A cage of quads alone after some levels of refinement.
struct RefinedCage {
    std::vector<CagePoint> points;
    std::vector<std::uint32_t> corners;     // four a face
    std::vector<std::uint32_t> base_faces;  // the face of the cage that each is part of
    std::vector<Vec2> uvs;                  // on the limit surface, four a face; empty without
    std::vector<std::uint32_t> holes;       // faces without a surface
    std::vector<SharpEdge> creases;         // infinitely sharp
    std::vector<std::uint32_t> sharp_vertices;
    SubdivisionRules rules;
    bool rounded_much = false;  // some sharpness was, and further levels would show it
};

/// A face as a bicubic patch, points as in BicubicPatch; its corner k is the face's.
struct CagePatch {
    std::uint32_t face;
    bool exact;  // false where the surface is no bicubic patch
    std::array<CagePoint, 16> points;
};

/// Every face has 3 corners or more and none twice; without levels, 4. Sharpness that is left after
/// the last level is rounded to none or infinite. Throws an Error at `where` if OpenSubdiv cannot
/// take the cage.
RefinedCage refine(const Cage& cage, int levels, const std::string& where);

/// The faces of the limit surface. At extraordinary vertices patches have their limit positions and
/// tangents (Loop, Schaefer, Ni and Castano, "Approximating subdivision surfaces with Gregory
/// patches for hardware tessellation", 2009), and the mean of a Gregory patch's two inner points.
std::vector<CagePatch> patches_of(const RefinedCage& cage, const std::string& where);

}  // namespace chiaro
