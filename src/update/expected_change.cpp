#include "update/expected_change.h"

#include <algorithm>

namespace chiaro {
namespace {

// An edit's own expectation counts as so many places where something was found.
constexpr float kPriorCount = 8;

// A single one that was nearly black says little about how much brighter others are.
constexpr float kMostFound = 4;

}  // namespace

float ExpectedChange::Evidence::mean() const {
    return std::max(kLeast, (kPriorCount * prior + sum) / (kPriorCount + count));
}

void ExpectedChange::expect(std::size_t objects, int channel, float relative2) {
    if (index_of(channel) >= channels_.size()) channels_.resize(index_of(channel) + 1);
    channels_[channel].resize(objects);
    for (Evidence& e : channels_[channel]) {
        e.prior = std::max(relative2, 0.5f * e.mean());
        const float kept = std::min(0.5f, kPriorCount / std::max(e.count, 1.0f));
        e.sum *= kept;
        e.count *= kept;
    }
}

void ExpectedChange::expect_of(ObjectId object, int channel, float relative2) {
    Evidence& e = channels_[channel][index_of(object)];
    e.prior = std::max(e.prior, relative2);
}

void ExpectedChange::found(ObjectId object, int channel, float relative2) {
    Evidence& e = channels_[channel][index_of(object)];
    e.sum += std::min(relative2, kMostFound);
    e.count += 1;
}

float ExpectedChange::relative2(ObjectId object, int channel) const {
    return channels_[channel][index_of(object)].mean();
}

}  // namespace chiaro
