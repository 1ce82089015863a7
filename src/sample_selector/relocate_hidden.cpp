#include "sample_selector/relocate_hidden.h"

namespace chiaro {

void relocate_hidden(ShadingCache& cache, const MeshFront& front) {
    // By vertex: one in view for which it speaks, and the part that it has in predicting that.
    struct Spoken {
        VertexId vertex = VertexId::none;
        float part = 0;
    };
    std::vector<Spoken> most(cache.vertices().size());
    const auto vertices = front.vertices();
    // Children come after their parents.
    for (std::size_t place = vertices.size(); place-- > 0;) {
        const VertexId id = vertices[place];
        Spoken& here = most[index_of(id)];
        if (front.shown(place)) here = {id, 1};
        if (here.vertex == VertexId::none) continue;
        if (!cache.of_root(id) && !cache.evaluated(id)) cache.relocate(id, here.vertex);
        const Parents parents = cache.parents(id);
        for (std::size_t i = 0; i < parents.size(); ++i) {
            Spoken& above = most[index_of(parents[i])];
            const float part = here.part * parents.weight(i);
            if (part > above.part) above = {here.vertex, part};
        }
    }
}

}  // namespace chiaro
