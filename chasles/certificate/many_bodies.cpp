#include "chasles/certificate/many_bodies.h"

#include "chasles/base/invalid_input.h"
#include "chasles/certificate/certified_body.h"
#include "chasles/certificate/hexadecimal.h"
#include "chasles/mesh/body.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace chasles::certificate {

namespace {

/// Calls with two bodies i < j and the number of their pair.
template <class Visit>
void for_each_pair(const ManyBodies& question, const Visit& visit) {
    std::size_t number = 0;
    for (std::size_t i = 0; i < question.bodies.size(); ++i)
        for (std::size_t j = i + 1; j < question.bodies.size(); ++j)
            visit(i, j, question.margins[number++]);
}

std::string pair_line(std::size_t i, std::size_t j, const std::optional<double>& margin) {
    const std::string words = std::to_string(i) + " " + std::to_string(j);
    return margin ? "pair " + words + " " + hexadecimal(*margin) + "\n" : "untested " + words + "\n";
}

std::string body_lines(const MovingBody& body, const std::string& hash, std::size_t piece_count, bool is_tested) {
    const auto& links = body.chain.links();
    const bool is_solid = is_tested && body.shape.body().volume().is_solid();
    return "body " + hash + " " + std::to_string(body.shape.face_count()) + (is_solid ? " solid " : " surface ") +
           hexadecimal(body.shape.radius()) + " " + std::to_string(links.size()) + "\n" +
           lines_of(body.chain, is_at_rest(body.chain) ? 0 : piece_count + 1);
}

/// For a comment.
std::string printable(std::string name) {
    std::ranges::replace_if(
        name, [](char c) { return c < ' ' || c > '~'; }, '?');
    return name;
}

/// Of bodies without a tested pair nothing is asked: they stand in a certificate as surfaces.
std::vector<bool> tested_bodies(const ManyBodies& question) {
    std::vector<bool> are_tested(question.bodies.size());
    for_each_pair(question, [&](std::size_t i, std::size_t j, const std::optional<double>& margin) {
        if (margin)
            are_tested[i] = are_tested[j] = true;
    });
    return are_tested;
}

CertifiedBodies shapes_of(const ManyBodies& question, const std::vector<bool>& are_tested) {
    CertifiedBodies shapes;
    std::set<const Body*> checked;
    for (std::size_t i = 0; i < question.bodies.size(); ++i) {
        const auto& [name, shape, chain] = question.bodies[i];
        if (are_tested[i] && checked.insert(&shape.body()).second)
            check_body(shape, name);
        shapes.add(shape);
    }
    return shapes;
}

std::string scene_line(const ManyBodies& question) {
    return "scene " + std::to_string(question.bodies.size()) + " " + std::to_string(question.piece_count) + "\n";
}

} // namespace

motion::ChainLinks chain_of(const motion::MovingFrame& frame, const std::string& name) {
    motion::ChainLinks chain;
    if (!frame.add_links(chain, false))
        refuse(name + ": the motion is none of those that are certified: products of poses, velocities, twists, hinges "
                      "and sliders that move evenly between the same times");
    return chain;
}

Certificate certify(const ManyBodies& question, const ManyClaim& answer) {
    const auto& [claim, first, second] = answer;
    const std::vector<bool> are_tested = tested_bodies(question);
    const CertifiedBodies shapes = shapes_of(question, are_tested);
    Certificate result{.text = "chasles certificate 1\n" + scene_line(question), .bodies = shapes.different()};
    for (std::size_t i = 0; i < question.bodies.size(); ++i)
        result.text += "# body " + std::to_string(i) + ": " + printable(question.bodies[i].name) + "\n" +
                       body_lines(question.bodies[i], shapes[i].hash, question.piece_count, are_tested[i]) +
                       order_line("", shapes[i].tree);
    result.text += "verdict " + words_of(claim);
    if (claim.verdict != Verdict::clear)
        result.text += " " + std::to_string(first) + " " + std::to_string(second);
    result.text += "\n";

    const auto motion_of = [&](std::size_t i, std::size_t j) {
        return CertifiedMotion(chain_between(question.bodies[i].chain, question.bodies[j].chain), question.piece_count);
    };
    std::optional<double> margin_of_contact;
    for_each_pair(question, [&](std::size_t i, std::size_t j, const std::optional<double>& margin) {
        const bool touches = claim.verdict != Verdict::clear && i == first && j == second;
        if (touches)
            margin_of_contact = margin;
        if (claim.verdict == Verdict::contact_at_start && !touches)
            return;
        result.text += pair_line(i, j, margin);
        if (!margin || claim.verdict == Verdict::contact_at_start)
            return;
        const CertifiedMotion motion = motion_of(i, j);
        const bool was_proven = result.missing.empty();
        TwoBodies(shapes[i].tree, shapes[j].tree, motion, *margin).add_proof(claim, result);
        if (was_proven && !result.missing.empty())
            result.missing += " (" + question.bodies[i].name + " and " + question.bodies[j].name + ")";
    });
    if (margin_of_contact) {
        const CertifiedMotion motion = motion_of(first, second);
        TwoBodies(shapes[first].tree, shapes[second].tree, motion, *margin_of_contact).add_witness(claim, result);
    }
    return result;
}

/// By all lines that say what the question is; their order is fixed. The proofs are left to the checker.
bool is_about(const std::string& text, const ManyBodies& question) {
    std::string given;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        for (const char* const word : {"scene ", "body ", "link ", "knot ", "pair ", "untested "})
            if (line.starts_with(word))
                given += line + "\n";
    std::string bodies = scene_line(question), pairs;
    const std::vector<bool> are_tested = tested_bodies(question);
    std::map<const Body*, std::string> hashes;
    for (std::size_t i = 0; i < question.bodies.size(); ++i) {
        const Polyhedron& shape = question.bodies[i].shape;
        std::string& hash = hashes[&shape.body()];
        if (hash.empty())
            hash = hash_of(shape);
        bodies += body_lines(question.bodies[i], hash, question.piece_count, are_tested[i]);
    }
    for_each_pair(question, [&](std::size_t i, std::size_t j, const std::optional<double>& margin) {
        pairs += pair_line(i, j, margin);
    });
    if (text.find("\nverdict start ") == std::string::npos)
        return given == bodies + pairs;
    const bool fits = given.starts_with(bodies) && given.size() > bodies.size(); // and only the pair of the contact
    return fits && ("\n" + pairs).find("\n" + given.substr(bodies.size())) != std::string::npos;
}

} // namespace chasles::certificate
