#include "chasles/certificate/certificate.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/limit.h"
#include "chasles/certificate/certified_body.h"
#include "chasles/certificate/hexadecimal.h"
#include "chasles/certificate/piece_motion.h"
#include "chasles/certificate/two_bodies.h"
#include "chasles/mesh/body.h"
#include "chasles/query/all_answers.h"
#include "chasles/query/requirements.h"

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

/// The moving and the fixed one.
CertifiedBodies bodies_of(const Polyhedron& moving, const Polyhedron& fixed) {
    check_body(moving, "the moving body");
    check_body(fixed, "the fixed body");
    CertifiedBodies bodies;
    bodies.add(moving);
    bodies.add(fixed);
    return bodies;
}

/// The question, and what is found by asking for the answer. The bodies are kept by reference.
class Certifier {
public:
    Certifier(const CertifiedBodies& bodies, std::span<const Motion> path, const QueryOptions& options)
        : bodies_(bodies), moving_(bodies[0].shape), fixed_(bodies[1].shape), options_(options), motion_(path) {
        if (options.hold)
            refuse("answers with `hold` are not certified");
        options_.find = Find::first;
    }

    Certificate run() const {
        const Claim claim = answer();
        const FaceTree &own = bodies_[0].tree, &other = bodies_[1].tree;
        const TwoBodies bodies(own, other, motion_, options_.margin);
        Certificate result{.text = head(claim), .bodies = {moving_, fixed_}};
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

    const CertifiedBodies& bodies_;
    const Polyhedron &moving_, &fixed_;
    QueryOptions options_;
    CertifiedMotion motion_;
};

} // namespace

} // namespace certificate

Certificate certify(const FirstContactQuery& query) {
    return certify(PathQuery{query.moving, query.fixed, {query.motion}, query.options});
}

Certificate certify(const PathQuery& query) {
    if (query.motions.empty())
        certificate::refuse("the path has no motion");
    const certificate::CertifiedBodies bodies = certificate::bodies_of(query.moving, query.fixed);
    return certificate::Certifier(bodies, query.motions, query.options).run();
}

std::vector<Certificate> certify_batch(const BatchQuery& query) {
    query::check_options(query.options);
    const certificate::CertifiedBodies bodies = certificate::bodies_of(query.moving, query.fixed);
    const Certificate none{.missing = "certificate: the limit was reached"};
    const auto proof = [&](std::size_t i) {
        try {
            return certificate::Certifier(bodies, query.motions.subspan(i, 1), query.options).run();
        } catch (const InvalidInput& error) {
            return Certificate{.missing = error.what()};
        } catch (const Cancelled&) {
            return none;
        }
    };
    return query::all_answers<Certificate>(query.motions.size(), query.batch, proof, none);
}

bool is_about(const std::string& text, std::span<const Motion> path) {
    return text.find("\n" + certificate::CertifiedMotion(path).lines() + "verdict ") != std::string::npos;
}

} // namespace chasles
