#include "sample_selector/stand_ins.h"

namespace chiaro {
namespace {

// A vertex in view, and the part that another has in predicting it.
struct Spoken {
    VertexId vertex = VertexId::none;
    float part = 0;
};

bool evaluated(const ShadingCache& cache, VertexId vertex) {
    for (int c = 0; c < cache.channels(); ++c)
        if (cache.evaluated(vertex, c)) return true;
    return false;
}

}  // namespace

void sample_hidden_in_view(ShadingCache& cache, const MeshFront& front) {
    const auto vertices = front.vertices();
    std::vector<Spoken> most(cache.vertices().size());
    // Children come after their parents.
    for (std::size_t place = vertices.size(); place-- > 0;) {
        const VertexId id = vertices[place];
        Spoken& here = most[index_of(id)];
        if (front.seen(place)) here = {id, 1};
        if (here.vertex == VertexId::none) continue;
        if (here.vertex != id && !evaluated(cache, id)) cache.stand_in(id, here.vertex);
        const CacheVertex& v = cache.vertex(id);
        const auto parents = v.known_parents();
        for (std::size_t i = 0; i < parents.size(); ++i) {
            Spoken& above = most[index_of(parents[i])];
            const float part = here.part * v.weight(i);
            if (part > above.part) above = {here.vertex, part};
        }
    }
}

}  // namespace chiaro
