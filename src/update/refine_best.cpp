// Refinement of the best scheme: patches drawn at random in proportion to what they would gain.

#include "base/parallel.h"
#include "sample_selector/gain.h"
#include "update/outdate.h"
#include "update/start_level.h"
#include "update/update_cycle.h"

#include <algorithm>

namespace chiaro {
namespace {

// Equation 1's epsilon: the part of the choices that priorities have no say in.
constexpr float kChance = 0.03f;

// Vertices of the cache for each point that is shaded between two looks at all that changed, and
// those that values are carried to.
constexpr std::size_t kVerticesAPoint = 5;
constexpr std::size_t kVerticesCarriedAPoint = 24;

// All that is stale is looked at again once it has waited for so much longer, as a part of how long
// it has: what changes by then is about the same each time.
constexpr Cycle kWaitingALook = 8;  // an eighth

// Patches whose gains one thread reckons at once.
constexpr std::size_t kBlock = 1024;

}  // namespace

void UpdateCycle::refine() {
    ShadeWork work = new_work();
    touched_.clear();
    touched_vertices_.clear();
    choose(work);
    // Nothing is left that gains before it is known what was learned.
    const bool idle = work.points() == 0;
    shade(work);
    {
        const StepTimer timer(statistics_.timings, Step::sample_selection);
        for (const auto& [patch, channel] : touched_) {
            expose_if_seen(cache_, patch);
            front_[channel].set(index_of(patch), front_gain(patch, channel));
        }
        for (const auto& [vertex, channel] : touched_vertices_)
            mesh_front_.reckon(cache_, vertex, channel, gains_);
    }
    if (idle || points_since_carry_ * kVerticesCarriedAPoint >= vertices_carried_) carry_down();
    // Neighbours of what was shaded learn of it here. Waiting for a part of the vertices keeps
    // this look at everything a small part of the whole.
    if (points_since_refresh_ * kVerticesAPoint > cache_.vertices().size())
        refresh(Extent::what_changed);
}

// Dense meshes learn sooner, as many vertices wait for few: of each vertex those that it speaks
// for, and the patches whose corners are known now.
void UpdateCycle::carry_down() {
    const StepTimer timer(statistics_.timings, Step::update_display_meshes);
    points_since_carry_ = 0;
    vertices_carried_ = 0;
    for (int c = 0; c < cache_.channels(); ++c) {
        vertices_carried_ += mesh_front_.carry(cache_, news_[c], c, gains_, settings_.threads);
        reckon_roots_round(news_[c], c);
        news_[c].clear();
    }
}

void UpdateCycle::reckon_roots_round(std::span<const VertexId> vertices, int channel) {
    std::vector<std::uint32_t> roots;
    for (const VertexId v : vertices)
        for (const PatchId root : mesh_front_.roots_round(v))
            roots.push_back(static_cast<std::uint32_t>(index_of(root)));
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());

    std::vector<float> gains(roots.size());
    parallel_for_ranges(settings_.threads, roots.size(), kBlock, [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i)
            gains[i] = front_gain(static_cast<PatchId>(roots[i]), channel);
    });
    front_[channel].set_many(roots, gains);
}

double UpdateCycle::seconds_budget() const {
    constexpr double kFixedSeconds = 0.05;
    return settings_.fixed_size ? kFixedSeconds : settings_.cycle_seconds * threads_at_once();
}

// Processor seconds for refinement; while edits come in every cycle, what the start has left.
double UpdateCycle::refine_seconds() const {
    constexpr double kLeast = 0.2;  // of a cycle
    if (in_haste() && !settings_.fixed_size) return seconds_left(kLeast) / overrun_;
    return seconds_budget() * (1 - polish_share());
}

double UpdateCycle::work_seconds(const ShadeWork& work) const {
    double seconds = 0;
    for (int c = 0; c < cache_.channels(); ++c)
        seconds += static_cast<double>(work.samples(c)) * gains_.seconds_a_sample[c];
    return seconds;
}

void UpdateCycle::choose(ShadeWork& work) {
    const StepTimer timer(statistics_.timings, Step::sample_selection);
    const double budget = refine_seconds();
    // Each choice either adds work or takes a patch out of the draw, so this ends.
    for (int tries = 0; tries < 200000 && work_seconds(work) < budget; ++tries) {
        if (rng_.uniform() < kChance) {
            spend_by_chance(work);
            continue;
        }
        const std::optional<Choice> choice = draw_choice();
        if (!choice) break;
        if (choice->patch != PatchId::none)
            spend_on(choice->patch, choice->channel, work);
        else
            spend_on(choice->vertex, choice->channel, work);
    }
}

// Whatever lies below a random pixel is divided, or sampled again at a random corner: an error that
// no estimate shows is found in the end.
void UpdateCycle::spend_by_chance(ShadeWork& work) {
    const auto below = [&](std::size_t n) { return rng_.below(static_cast<std::uint32_t>(n)); };
    const int channel = static_cast<int>(below(cache_.channels()));
    const PatchId id = front_patch_at(below(map_.first_of_pixel.size() - 1), channel);
    if (id == PatchId::none) return;
    const Patch& patch = cache_.patch(id);
    const int first = static_cast<int>(below(patch.corner_count()));
    for (int i = 0; i < patch.corner_count(); ++i) {
        const VertexId corner = patch.corners[(first + i) % patch.corner_count()];
        if (cache_.evaluated(corner, channel)) continue;
        spend_on(corner, channel, work);
        return;
    }
    if (rng_.below(2) == 0) {
        resample(patch.corners[below(patch.corner_count())], channel,
                 samples_of_new(cache_, id, channel, gains_), work);
        touched_.emplace_back(id, channel);
    } else if (patch.fragment_count > 1 && patch.divisible()) {
        front_[channel].set(index_of(id), 0);
        divide(id, channel, work);
    }
}

std::optional<UpdateCycle::Choice> UpdateCycle::draw_choice() {
    double total = 0;
    for (int c = 0; c < cache_.channels(); ++c) total += front_[c].total() + mesh_front_.total(c);
    double rest = rng_.uniform() * total;
    std::optional<Choice> choice;
    for (int c = 0; c < cache_.channels() && rest >= 0; ++c) {
        if (front_[c].total() > 0) choice = Choice{.channel = c, .patch = PatchId{0}};
        rest -= front_[c].total();
        if (rest < 0) break;
        if (mesh_front_.total(c) > 0) choice = Choice{.channel = c, .vertex = VertexId{0}};
        rest -= mesh_front_.total(c);
    }
    if (!choice) return choice;
    const float u = rng_.uniform();
    if (choice->patch != PatchId::none)
        choice->patch = static_cast<PatchId>(front_[choice->channel].draw(u));
    else
        choice->vertex = mesh_front_.draw(choice->channel, u);
    return choice;
}

// The front's patch in a channel below a pixel; none where the channel lights nothing.
PatchId UpdateCycle::front_patch_at(std::uint32_t pixel, int channel) {
    const auto fragments = map_.at_pixel(pixel);
    if (fragments.empty()) return PatchId::none;
    PatchId id = fragments[rng_.below(static_cast<std::uint32_t>(fragments.size()))].patch;
    if (!(cache_.pixels(cache_.patch(id), channel) > 0)) return PatchId::none;
    while (!on_front(cache_, id, channel)) id = static_cast<PatchId>(cache_.patch(id).parent);
    return id;
}

// Does the better of the two things that can be done for a patch: refine, or sample its noisiest
// corner again. Its gain is reckoned anew once that is shaded.
void UpdateCycle::spend_on(PatchId id, int channel, ShadeWork& work) {
    const Gain g = gain(cache_, id, channel, gains_);
    front_[channel].set(index_of(id), 0);
    if (g.resample > g.refine) {
        resample(g.noisiest, channel, samples_of_new(cache_, id, channel, gains_), work);
        touched_.emplace_back(id, channel);
        return;
    }
    if (g.refine > 0) divide(id, channel, work);
}

void UpdateCycle::resample(VertexId id, int channel, std::uint32_t of_new, ShadeWork& work) const {
    const Estimate* e = cache_.estimate(id, channel);
    const bool stale = e && e->stale;
    work.resample(cache_, id, channel, stale ? samples_of_stale(*e, channel, of_new, gains_) : 0);
}

// Evaluates a vertex of a mesh, or samples again one that speaks for others.
void UpdateCycle::spend_on(VertexId id, int channel, ShadeWork& work) {
    mesh_front_.rest(id, channel);
    const std::uint32_t of_new = samples_of_new(cache_, id, channel, gains_);
    if (cache_.evaluated(id, channel))
        resample(id, channel, of_new, work);
    else
        work.evaluate(cache_, id, channel, of_new);
    touched_vertices_.emplace_back(id, channel);
}

// Refines a channel in a patch of its front: divides the patch if nobody has yet, and asks for the
// children's corners that are in view.
void UpdateCycle::divide(PatchId id, int channel, ShadeWork& work) {
    if (cache_.patch(id).is_leaf()) {
        const StepTimer timer(statistics_.timings, Step::patch_subdivision);
        subdivide_seen(cache_, map_, id, static_cast<Cycle>(statistics_.cycles));
        for (SumTree& tree : front_) tree.resize(cache_.patches().size());
    }
    const std::uint32_t samples = samples_of_new(cache_, id, channel, gains_);
    cache_.patch(id).refined_channels |= static_cast<std::uint8_t>(1u << channel);
    for (int c = 0; c < child_count(cache_.patch(id).split); ++c) {
        const PatchId child = offset_by(cache_.patch(id).first_child, c);
        const Patch& p = cache_.patch(child);
        if (!(cache_.pixels(p, channel) > 0)) continue;
        for (int i = 0; i < p.corner_count(); ++i)
            work.evaluate(cache_, p.corners[i], channel, samples);
        touched_.emplace_back(child, channel);
    }
}

float UpdateCycle::front_gain(PatchId id, int channel) const {
    if (!(cache_.pixels(cache_.patch(id), channel) > 0) || !on_front(cache_, id, channel)) return 0;
    return gain(cache_, id, channel, gains_).best();
}

// What a patch gains in one channel depends on its light in all.
bool UpdateCycle::front_changed(PatchId id) const {
    const Patch& patch = cache_.patch(id);
    for (int i = 0; i < patch.corner_count(); ++i)
        if (cache_.changed(patch.corners[i])) return true;
    return false;
}

// Carries what is known from coarse to fine and reckons the gains that it concerns.
void UpdateCycle::refresh(Extent extent) {
    {
        const StepTimer timer(statistics_.timings, Step::update_display_meshes);
        cache_.resolve();
    }
    points_since_refresh_ = 0;
    const auto now = static_cast<Cycle>(statistics_.cycles);
    if (stale_.all > 0 && (extent == Extent::everything || now >= reconsider_at_)) {
        const Waiting waiting = {now - edited_at_, now - gloss_stale_at_};
        stale_ = reconsider_stale(cache_, expected_, least_light(gains_.scale), waiting,
                                  settings_.threads);
        reconsider_at_ = now + 1 + std::min(waiting.irradiance, waiting.glossy) / kWaitingALook;
    }
    if (statistics_.points_shaded > 2 * points_at_exposure_) {
        estimate_exposure();
        extent = Extent::everything;
    }
    if (settings_.scheme == Scheme::best) {
        const StepTimer timer(statistics_.timings, Step::sample_selection);
        for (int c = 0; c < cache_.channels(); ++c) reckon_front(c, extent);
        if (extent == Extent::everything) {
            mesh_front_.reckon(cache_, gains_, settings_.threads);
            for (auto& news : news_) news.clear();
        }
    }
    cache_.forget_changes();
}

void UpdateCycle::reckon_front(int channel, Extent extent) {
    const SumTree& known = front_[channel];
    std::vector<float> gains(cache_.patches().size(), 0.0f);
    parallel_for_ranges(settings_.threads, gains.size(), kBlock, [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
            const auto id = static_cast<PatchId>(i);
            const bool as_before =
                extent == Extent::what_changed && i < known.size() && !front_changed(id);
            gains[i] = as_before ? known.weight(i) : front_gain(id, channel);
        }
    });
    front_[channel].assign(gains);
}

}  // namespace chiaro
