// How far light is expected to have changed where nobody has looked since an edit (5.2).
#pragma once

#include "base/ids.h"

#include <cstddef>
#include <vector>

namespace chiaro {

/// Squared change of light, over its square, by object and channel: what an edit lets expect, and
/// what new samples find on the same object. "Objects that detect such a change in shading are also
/// aged": here what is found on a part of an object is expected of the rest.
class ExpectedChange {
public:
    /// An edit may have changed a channel everywhere by that (0: not at all). What was found before
    /// counts half, and no more than what this edit lets expect, as it was of another.
    void expect(std::size_t objects, int channel, float relative2);
    /// On one object it may have by that, if not by more.
    void expect_of(ObjectId object, int channel, float relative2);
    /// New samples took the place of old ones. (May be negative, where noise is subtracted.)
    void found(ObjectId object, int channel, float relative2);

    /// >= kLeast.
    float relative2(ObjectId object, int channel) const;

    /// Below this nobody would see it.
    static constexpr float kLeast = 1e-4f;

private:
    struct Evidence {
        float prior = 0;
        float sum = 0;
        float count = 0;
        float mean() const;
    };
    std::vector<std::vector<Evidence>> channels_;  // by channel, by object
};

}  // namespace chiaro
