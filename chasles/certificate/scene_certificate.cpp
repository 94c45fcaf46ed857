// Certificates of scenes. Source: docs/certificate.md, "Scenes".
#include "chasles/base/limit.h"
#include "chasles/certificate/many_bodies.h"
#include "chasles/scene/pair_question.h"

#include <algorithm>

namespace chasles {

namespace {

using certificate::ManyBodies;
using certificate::ManyClaim;
using certificate::refuse;

/// The stamps of all motions.
std::vector<double> times_of(const std::vector<certificate::MovingBody>& bodies) {
    const certificate::MovingBody* first = nullptr;
    for (const certificate::MovingBody& body : bodies) {
        if (certificate::is_at_rest(body.chain))
            continue;
        if (first && first->chain.times() != body.chain.times())
            refuse(first->name + " and " + body.name + " move by motions with stamps at different times");
        first = &body;
    }
    return first ? first->chain.times() : std::vector<double>{0, 1};
}

ManyBodies question_of(const Scene& scene, const SceneQuery& query) {
    const std::size_t count = scene.bodies().size();
    if (count < 2)
        refuse("the scene has fewer than two bodies");
    if (query.until != 1)
        refuse("answers with `until` are not certified");
    ManyBodies question;
    for (std::size_t i = 0; i < count; ++i) {
        const SceneBody& body = scene.bodies()[i];
        question.bodies.push_back({body.name, body.shape, certificate::chain_of(*scene.motion_of(i).frame, body.name)});
    }
    question.piece_count = times_of(question.bodies).size() - 1;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j) {
            const bool is_tested = !scene.is_ignored(i, j) && !(scene.rests(i) && scene.rests(j));
            const QueryOptions options = scene.options_of(i, j, query.options);
            if (is_tested && options.hold)
                refuse("answers with `hold` are not certified");
            question.margins.push_back(is_tested ? std::optional(options.margin) : std::nullopt);
        }
    return question;
}

ManyClaim answer_of(const Scene& scene, SceneQuery query, const std::vector<double>& times) {
    query.options.find = Find::first;
    const SceneAnswer answer = scene.first_contact(query);
    if (answer.verdict == Verdict::unknown)
        throw Cancelled();
    if (answer.verdict == Verdict::clear)
        return {};
    const SceneContact& first = answer.contacts.front();
    ManyClaim claim{certificate::claim_at(times, first.contact), first.moving, first.fixed};
    if (claim.first > claim.second)
        claim.exchange();
    return claim;
}

} // namespace

Certificate certify(const Scene& scene, const SceneQuery& query) {
    const ManyBodies question = question_of(scene, query);
    return certificate::certify(question, answer_of(scene, query, times_of(question.bodies)));
}

bool is_about(const std::string& text, const Scene& scene, const SceneQuery& query) {
    return certificate::is_about(text, question_of(scene, query));
}

} // namespace chasles
