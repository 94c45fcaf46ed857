#include "chasles/certificate/certificate.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/limit.h"
#include "chasles/certificate/certified_body.h"
#include "chasles/certificate/hexadecimal.h"
#include "chasles/certificate/piece_motion.h"
#include "chasles/certificate/two_bodies.h"
#include "chasles/mesh/body.h"

#include <algorithm>

namespace chasles {

namespace certificate {

namespace {

std::string line(const std::string& word, std::initializer_list<double> numbers) {
    std::string text = word;
    for (const double number : numbers)
        text += " " + hexadecimal(number);
    return text + "\n";
}

std::string body_line(const CertifiedBody& body) {
    return " " + body.hash + " " + std::to_string(body.shape.face_count()) + "\n";
}

/// The question, and what is found by asking for the answer.
class Certifier {
public:
    explicit Certifier(const PathQuery& query)
        : moving_(query.moving), fixed_(query.fixed), options_(query.options), motion_(query.motions) {
        options_.find = Find::first;
        bodies_.add(moving_, "the moving body");
        bodies_.add(fixed_, "the fixed body");
    }

    Certificate run() const {
        const Claim claim = answer();
        const FaceTree &own = bodies_[0].tree, &other = bodies_[1].tree;
        const TwoBodies bodies(own, other, motion_, options_.margin);
        Certificate result{head(claim)};
        if (claim.verdict != Verdict::contact_at_start) {
            result.text += order_line("moving", own) + order_line("fixed", other);
            bodies.add_proof(claim, result);
        }
        if (claim.verdict != Verdict::clear)
            bodies.add_witness(claim, result);
        return result;
    }

private:
    /// The first contact.
    [[nodiscard]] Claim answer() const {
        for (const CertifiedMotion::Part& part : motion_.parts()) {
            const FirstContact found = first_contact({moving_, fixed_, part.motion, options_});
            if (found.verdict == Verdict::unknown)
                throw Cancelled();
            if (found.verdict != Verdict::clear)
                return claim_in(part, found);
        }
        return {};
    }
    [[nodiscard]] Claim claim_in(const CertifiedMotion::Part& part, const FirstContact& found) const {
        Claim claim = motion_.is_screw() ? Claim(found, 0, found.tau) : claim_at(part.times, found);
        claim.piece += part.first_piece;
        return claim;
    }

    [[nodiscard]] std::string head(const Claim& claim) const {
        const bool a = moving_.body().volume().is_solid(), b = fixed_.body().volume().is_solid();
        std::string text =
            "chasles certificate 1\nmoving" + body_line(bodies_[0]) + "fixed" + body_line(bodies_[1]) + "solid ";
        text += a && b ? "both\n" : a ? "moving\n" : b ? "fixed\n" : "none\n";
        text += line("radius", {moving_.radius(), fixed_.radius()}) + line("margin", {options_.margin});
        return text + motion_.lines() + "verdict " + words_of(claim) + "\n";
    }

    Polyhedron moving_, fixed_;
    QueryOptions options_;
    CertifiedMotion motion_;
    CertifiedBodies bodies_;
};

} // namespace

} // namespace certificate

Certificate certify(const FirstContactQuery& query) {
    return certify(PathQuery{query.moving, query.fixed, {query.motion}, query.options});
}

Certificate certify(const PathQuery& query) {
    if (query.motions.empty())
        throw InvalidInput("certificate: the path has no motion");
    if (query.options.hold)
        throw InvalidInput("certificate: answers with `hold` are not certified");
    return certificate::Certifier(query).run();
}

bool is_about(const std::string& text, std::span<const Motion> path) {
    return text.find("\n" + certificate::CertifiedMotion(path).lines() + "verdict ") != std::string::npos;
}

} // namespace chasles
