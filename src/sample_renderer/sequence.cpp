#include "sample_renderer/sequence.h"

namespace chiaro {

const Sequence::Table& Sequence::table() {
    static const Table table = [] {
        Table points;
        for (int d = 0; d < kDimensions; ++d)
            for (std::uint32_t i = 0; i < kTableSize; ++i) points[d][i] = halton(d, i);
        return points;
    }();
    return table;
}

}  // namespace chiaro
