// The changes of a robot since it was made, to save it and to make it again.
#include "chasles/robot/model.h"
#include "chasles/robot/robot.h"

namespace chasles {

using robot::Model;

RobotChanges Robot::changes() const {
    const Model& model = *model_;
    const auto names_of = [&](const Model::OwnerPair& pair) {
        return RobotChanges::Names(model.owners[pair.first].name, model.owners[pair.second].name);
    };
    RobotChanges changes{model.base, model.parts};
    for (const Model::OwnerPair& pair : model.ignored)
        changes.ignored.push_back(names_of(pair));
    changes.ignored_in_scene.assign(model.ignored_in_scene.begin(), model.ignored_in_scene.end());
    for (const auto& [pair, margin] : model.margins)
        changes.margins.emplace_back(names_of(pair), margin);
    return changes;
}

Robot::Robot(RobotDescription description, const RobotChanges& changes) : Robot(std::move(description)) {
    set_base(changes.base);
    for (const AttachedPart& part : changes.parts)
        attach(part);
    auto model = std::make_shared<Model>(*model_);
    model->ignored.clear(); // the pairs of the description are among those of the changes, unless they are tested again
    for (const auto& [first, second] : changes.ignored)
        model->ignored.insert(model->owners_of(first, second));
    model_ = std::move(model);
    for (const auto& [link, body] : changes.ignored_in_scene)
        ignore_in_scene(link, body);
    for (const auto& [pair, margin] : changes.margins)
        set_margin(pair.first, pair.second, margin);
}

} // namespace chasles
