#include "update/session.h"

#include "base/random.h"

namespace chiaro {

Session::Session(Scene scene, const Camera& camera, const SessionSettings& settings)
    : settings_(settings),
      scene_(std::move(scene)),
      camera_(camera),
      rays_(scene_, settings.update.threads, settings.curve_tolerance),
      graphs_(scene_, coarser_levels(settings.update.scheme), settings.update.threads),
      open_sides_(scene_) {
    light_anew(true);
    cycle_.emplace(rays_, graphs_, *renderer_, open_sides_, settings_.update);
    cycle_->look_from(view());
}

Edit Session::apply(const Edit& edit) {
    if (changes_nothing(scene_, camera_, edit)) return edit;
    const EditEffect effect = effect_of(scene_, edit);
    Edit inverse = chiaro::apply(scene_, camera_, edit);
    follow(edit, effect);
    effects_.push_back(effect);
    looks_elsewhere_ |= effect.camera;
    return inverse;
}

// What must know of each edit at once.
void Session::follow(const Edit& edit, const EditEffect& effect) {
    if (const auto* moved = std::get_if<SetTransform>(&edit)) rays_.set_transform(moved->object);
    if (const auto* shown = std::get_if<SetShown>(&edit)) rays_.set_shown(shown->object);
    if (effect.material != MaterialId::none && effect.geometry) rays_.set_material(effect.material);
    if (std::holds_alternative<AddObject>(edit)) {
        rays_.add_objects();
        open_sides_.add_objects(scene_);
        graphs_.add_meshes(scene_, settings_.update.threads);
    }
}

// What a renderer remembers is of the scene as it was, and so are, where `lights` are others, their
// lists.
void Session::light_anew(bool lights) {
    renderer_.reset();
    if (lights) area_lights_.emplace(scene_);
    renderer_ = make_renderer(settings_.renderer, scene_, rays_, *area_lights_, &open_sides_,
                              settings_.update.threads, short_seed(settings_.update.seed));
}

// With the channels that the scene needs by now; what was shaded is lost, what was counted is not.
void Session::begin_anew() {
    const Statistics so_far = cycle_->statistics();
    cycle_.emplace(rays_, graphs_, *renderer_, open_sides_, settings_.update).carry_on(so_far);
    cycle_->look_from(view());
}

void Session::run() {
    if (!effects_.empty()) {
        const SceneChange change = change_of(effects_);
        if (change.any()) light_anew(change.lights);
        if (cycle_->lacks_channel())
            begin_anew();
        else
            cycle_->scene_changed(change, *renderer_);
        effects_.clear();
    }
    if (looks_elsewhere_) cycle_->look_from(view());
    looks_elsewhere_ = false;
    cycle_->run();
}

}  // namespace chiaro
