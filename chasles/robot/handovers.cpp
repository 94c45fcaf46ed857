// Parts keep their places where they change hands: in double-double, as segments meet.
#include "chasles/robot/handovers.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/motion/screw_path.h"
#include "chasles/robot/segment_pairs.h"

#include <algorithm>
#include <set>

namespace chasles::robot {

namespace {

using Prepared = RobotChecker::Prepared;

[[noreturn]] void refuse_handover(std::size_t index, const std::string& why) {
    throw InvalidInput("handover " + std::to_string(index) + ": " + why);
}

/// The segment that begins at the stamp of a handover.
std::size_t segment_after(const JointPath& path, std::size_t index, const Handover& handover) {
    const std::vector<JointPath::Segment>& segments = path.segments();
    std::string ends;
    for (std::size_t s = 0; s + 1 < segments.size(); ++s) {
        if (segments[s].end == handover.stamp)
            return s + 1;
        if (s < 10)
            ends += (s > 0 ? ", " : "") + number_text(segments[s].end, 17);
    }
    refuse_handover(index, "no segment of the path ends at the stamp " + number_text(handover.stamp, 17) +
                               ", or it is the last one" +
                               (ends.empty() ? "; the path has one segment"
                                             : "; segments end at " + ends + (segments.size() > 11 ? ", ..." : "")));
}

void check(const Model& model, std::size_t index, const Handover& handover) {
    if (std::ranges::find(model.parts, handover.part, &AttachedPart::name) == model.parts.end())
        refuse_handover(index, "there is no part " + handover.part);
    const auto link = std::ranges::find(model.description.links, handover.link, &LinkDescription::name);
    if (link == model.description.links.end())
        refuse_handover(index, "there is no link " + handover.link);
    for (const std::string& touching : handover.touch_links)
        if (!model.owner_of.contains(touching) || touching == handover.part)
            refuse_handover(index, touching + " is no other link or part");
}

} // namespace

void Model::let_touch(std::string_view part, std::string_view link, const std::vector<std::string>& touch_links) {
    ignored.insert(owners_of(part, link));
    for (const std::string& name : touch_links)
        ignored.insert(owners_of(part, name));
}

void Model::hand_over(std::string_view part, std::string_view link, const SegmentMotion& segment) {
    const std::size_t index = owner(part);
    Owner& moved = owners[index];
    const std::size_t group = owners[owner(link)].group;
    const motion::FixedPose carrier = place_of(segment, group, {}, 0);
    moved.place = carrier.inverse() * place_of(segment, moved.group, moved.place, 0);
    moved.group = group;
    for (Element& element : elements)
        if (element.owner == index) {
            element.place = moved.place;
            element.group = group;
        }
    AttachedPart& attached = *std::ranges::find(parts, part, &AttachedPart::name);
    attached.link = link;
    attached.pose = motion::rounded((owners[owner(link)].place.inverse() * moved.place).refined);
}

Stretches::Stretches(const Prepared& prepared, const JointPath& path, std::span<const Handover> handovers)
    : given_(prepared), untested_(prepared.untested) {
    if (handovers.empty())
        return;
    const SegmentPairs first(prepared, path, 0); // refuses a path of another robot
    Model model = prepared.model();
    for (std::size_t i = 0; i < handovers.size(); ++i) {
        check(model, i, handovers[i]);
        if (i > 0 && !(handovers[i - 1].stamp <= handovers[i].stamp))
            refuse_handover(i, "its stamp is earlier than that of the one before");
        model.let_touch(handovers[i].part, handovers[i].link, handovers[i].touch_links);
    }
    stretches_.push_back({0, std::make_shared<const Prepared>(prepared, model)});
    for (std::size_t i = 0; i < handovers.size(); ++i) {
        const std::size_t segment = segment_after(path, i, handovers[i]);
        model.hand_over(handovers[i].part, handovers[i].link, model.motion_of(path.segments()[segment]));
        if (i + 1 == handovers.size() || handovers[i + 1].stamp != handovers[i].stamp)
            stretches_.push_back({segment, std::make_shared<const Prepared>(prepared, model)});
    }
    count_pairs_at_rest();
}

const Prepared& Stretches::at(std::size_t segment) const {
    const auto later = std::ranges::upper_bound(stretches_, segment, {}, &Stretch::first_segment);
    return later == stretches_.begin() ? given_ : *(later - 1)->prepared;
}

/// All stretches have the same ignored pairs. They differ by what does not move against what.
void Stretches::count_pairs_at_rest() {
    const Prepared& first = *stretches_.front().prepared;
    std::set<std::size_t> with_shapes;
    for (const Element& element : first.model().elements)
        with_shapes.insert(element.owner);
    std::set<Model::OwnerPair> at_rest;
    for (const Stretch& stretch : stretches_)
        for (const AttachedPart& part : first.model().parts)
            for (const std::size_t other : with_shapes) {
                const Model& model = stretch.prepared->model();
                const std::size_t owner = model.owner(part.name);
                if (other != owner && model.owners[other].group == model.owners[owner].group &&
                    first.model().is_tested(std::minmax(owner, other)))
                    at_rest.insert(std::minmax(owner, other));
            }
    UntestedPairs all = *first.untested;
    all.tested -= at_rest.size();
    for (const auto& [a, b] : at_rest)
        all.add(first.model().owners[a].name, first.model().owners[b].name, UntestedReason::at_rest);
    std::ranges::stable_sort(all.named, {}, &UntestedPair::reason);
    untested_ = std::make_shared<const UntestedPairs>(std::move(all));
}

} // namespace chasles::robot
