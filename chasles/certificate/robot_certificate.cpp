// Certificates of paths of robots. Source: docs/certificate.md, "Scenes".
#include "chasles/base/limit.h"
#include "chasles/certificate/many_bodies.h"
#include "chasles/robot/prepared.h"

#include <cmath>
#include <numbers>

namespace chasles {

namespace {

using certificate::ManyBodies;
using certificate::ManyClaim;
using certificate::refuse;
using motion::ChainLink;
using motion::ChainLinks;

/// The links of a chain, segment after segment. Poses and axes are rounded.
class LinksOfPath {
public:
    void add(const motion::Chain& chain) {
        std::vector<ChainLink> next;
        for (const auto& [before, joint] : chain.joints()) {
            if (!joint.value->is_straight())
                refuse("the path is not straight in joint space");
            next.push_back(link_of(before));
            next.push_back(link_of(joint));
        }
        next.push_back(link_of(chain.last()));
        if (links_.empty())
            links_ = std::move(next);
        else
            append(next);
    }
    [[nodiscard]] ChainLinks chain() const {
        ChainLinks chain;
        for (const ChainLink& link : links_)
            if (link.kind == ChainLink::Kind::pose)
                chain.add(link.poses.front(), false);
            else
                static_cast<void>(chain.add(link, {}));
        return chain;
    }

private:
    static ChainLink link_of(const motion::FixedPose& pose) { return {.poses = {motion::rounded(pose.refined)}}; }
    static ChainLink link_of(const motion::ElementaryJoint& joint) {
        const motion::Vector3<double>& axis = joint.axis.in_double;
        const auto value = [&](double time) { return double(joint.value->at(algebra::DoubleDouble(time))); };
        return {.kind = joint.turns ? ChainLink::Kind::turn : ChainLink::Kind::slide,
                .vector = {axis.x, axis.y, axis.z},
                .values = {value(0), value(1)}};
    }
    /// A continuous joint may begin whole turns from where it was.
    void append(const std::vector<ChainLink>& next) {
        for (std::size_t i = 0; i < links_.size(); ++i) {
            ChainLink& link = links_[i];
            if (link.kind == ChainLink::Kind::pose) {
                if (!certificate::is_same(link, next[i]))
                    refuse("a floating joint moves in several segments");
                continue;
            }
            const double gap = link.values.back() - next[i].values.front();
            const double turns = link.kind == ChainLink::Kind::turn ? std::round(gap / (2 * std::numbers::pi)) : 0;
            if (link.vector != next[i].vector || std::abs(gap - turns * 2 * std::numbers::pi) > 1e-9)
                refuse("a joint does not begin where the segment before ends");
            link.values.push_back(next[i].values.back() + gap);
        }
    }

    std::vector<ChainLink> links_;
};

class Question {
public:
    Question(const RobotChecker::Prepared& prepared, const JointPath& path)
        : prepared_(prepared), model_(prepared.model()), path_(path) {
        if (prepared.options.hold)
            refuse("answers with `hold` are not certified");
        if (prepared.options.find == Find::any)
            refuse("answers of yes or no (Find::any) are not certified; ask for the first contact");
        many_.piece_count = path.segments().size();
        add_elements();
        add_scene();
        if (many_.bodies.size() < 2)
            refuse("the robot and its scene have fewer than two shapes");
        add_margins();
    }
    [[nodiscard]] const ManyBodies& many() const { return many_; }

    [[nodiscard]] ManyClaim claim_of(const RobotAnswer& answer) const {
        if (answer.verdict == Verdict::unknown)
            throw Cancelled();
        if (answer.verdict == Verdict::clear)
            return {};
        const RobotPair& pair = *answer.pair;
        ManyClaim claim{{answer.contact, answer.segment, answer.contact.time},
                        element(pair.first, pair.first_shape),
                        pair.is_with_scene ? body(pair.second) : element(pair.second, pair.second_shape)};
        if (claim.first > claim.second)
            claim.exchange();
        return claim;
    }

private:
    void add_elements() {
        for (const robot::Element& element : model_.elements) {
            const auto [link, shape] = model_.name_of(element);
            many_.bodies.push_back({link + ", shape " + std::to_string(shape), element.shape, {}});
        }
        std::vector<LinksOfPath> links(model_.elements.size());
        for (const JointPath::Segment& segment : path_.segments()) {
            const robot::SegmentMotion motion = model_.motion_of(segment);
            for (std::size_t i = 0; i < model_.elements.size(); ++i)
                links[i].add(model_.chain(motion, model_.elements[i].group, model_.elements[i].place));
        }
        for (std::size_t i = 0; i < model_.elements.size(); ++i)
            many_.bodies[i].chain = links[i].chain();
    }
    void add_scene() {
        for (std::size_t i = 0; i < prepared_.bodies.size(); ++i) {
            const SceneBody& body = prepared_.bodies[i];
            const ChainLinks chain = certificate::chain_of(*prepared_.motions[i]->frame, body.name);
            if (!certificate::is_at_rest(chain) &&
                (many_.piece_count > 1 || chain.times() != std::vector<double>{0, 1}))
                refuse(body.name + ": moves, while the path or the motion has several segments");
            many_.bodies.push_back({body.name, body.shape, chain});
        }
    }
    void add_margins() {
        const std::size_t count = many_.bodies.size();
        std::vector<std::optional<double>> all(count * count);
        for (const auto& [moving, fixed, margin] : prepared_.self_pairs)
            all[std::min(moving, fixed) * count + std::max(moving, fixed)] = margin;
        const auto add = [&](robot::Task::Kind kind, std::size_t number) {
            for (std::size_t element = 0; element < model_.elements.size(); ++element) {
                const robot::Task task{kind, element, number, {0, 1}};
                const std::size_t body = prepared_.body_of(task);
                if (!prepared_.is_ignored(element, body))
                    all[element * count + model_.elements.size() + body] = prepared_.options_of(task).margin;
            }
        };
        for (std::size_t i = 0; i < prepared_.obstacles.size(); ++i)
            add(robot::Task::Kind::obstacle, i);
        for (std::size_t i = 0; i < prepared_.movers.size(); ++i)
            add(robot::Task::Kind::mover, i);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = i + 1; j < count; ++j)
                many_.margins.push_back(all[i * count + j]);
    }
    [[nodiscard]] std::size_t element(const std::string& name, std::size_t shape) const {
        const auto& elements = model_.elements;
        return std::size_t(std::ranges::find(elements, std::pair(name, shape),
                                             [&](const robot::Element& one) { return model_.name_of(one); }) -
                           elements.begin());
    }
    [[nodiscard]] std::size_t body(const std::string& name) const {
        return model_.elements.size() +
               std::size_t(std::ranges::find(prepared_.bodies, name, &SceneBody::name) - prepared_.bodies.begin());
    }

    const RobotChecker::Prepared& prepared_;
    const robot::Model& model_;
    const JointPath& path_;
    ManyBodies many_;
};

} // namespace

Certificate certify(const RobotChecker& checker, const JointPath& path) {
    const RobotAnswer answer = checker.first_contact(path);
    const Question question(checker.prepared(), path);
    return certificate::certify(question.many(), question.claim_of(answer));
}

std::vector<Polyhedron> bodies_of(const RobotChecker& checker) {
    std::vector<Polyhedron> bodies;
    for (const robot::Element& element : checker.prepared().model().elements)
        bodies.push_back(element.shape);
    for (const SceneBody& body : checker.prepared().bodies)
        bodies.push_back(body.shape);
    return bodies;
}

bool is_about(const std::string& text, const RobotChecker& checker, const JointPath& path) {
    return certificate::is_about(text, Question(checker.prepared(), path).many());
}

} // namespace chasles
