#include "chasles/certificate/certificate.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/limit.h"
#include "chasles/base/limit_of_thread.h"
#include "chasles/certificate/certified_body.h"
#include "chasles/certificate/hexadecimal.h"
#include "chasles/certificate/piece_motion.h"
#include "chasles/certificate/prover.h"
#include "chasles/certificate/witness.h"
#include "chasles/mesh/body.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace chasles {

namespace certificate {

namespace {

std::string line(const std::string& word, std::initializer_list<double> numbers) {
    std::string text = word;
    for (const double number : numbers)
        text += " " + hexadecimal(number);
    return text + "\n";
}

std::string body_line(const Polyhedron& body) {
    return " " + hash_of(body) + " " + std::to_string(body.face_count()) + "\n";
}

std::string order_line(const std::string& name, const FaceTree& tree) {
    std::string text = "order " + name;
    for (const std::uint32_t face : tree.order())
        text += " " + std::to_string(face);
    return text + "\n";
}

class Certifier {
public:
    explicit Certifier(const PathQuery& query)
        : moving_(query.moving), fixed_(query.fixed), options_(query.options), motion_(query.motions), own_(moving_),
          other_(fixed_),
          reach_(DoubleDouble(moving_.radius()) + DoubleDouble(fixed_.radius()) + DoubleDouble(options_.margin)) {
        options_.find = Find::first;
    }

    Certificate run() {
        answer();
        const bool is_start = verdict_ == Verdict::contact_at_start;
        std::string text = head();
        if (!is_start)
            text += order_line("moving", own_) + order_line("fixed", other_) + outside() + proof();
        result_.text = text + (verdict_ == Verdict::clear ? "" : witness());
        return result_;
    }

private:
    /// Brackets are wider by this at both ends: the bodies are apart before it, and pass through each other after it.
    static constexpr double beside = 0x1p-44;

    /// The first piece with a contact, and its tau there.
    void answer() {
        for (const CertifiedMotion::Part& part : motion_.parts()) {
            found_ = first_contact({moving_, fixed_, part.motion, options_});
            if (found_.verdict == Verdict::unknown)
                throw Cancelled();
            if (found_.verdict == Verdict::contact)
                find_piece(part);
            if (found_.verdict != Verdict::clear)
                break;
        }
        verdict_ = found_.verdict;
        found_.tau.lower = std::max(found_.tau.lower - beside, 0.0);
        found_.tau.upper = std::min(found_.tau.upper + beside, 1.0);
    }
    void find_piece(const CertifiedMotion::Part& part) {
        const auto after = std::ranges::lower_bound(part.times, found_.time.upper);
        const auto index = std::size_t(std::max<std::ptrdiff_t>(after - part.times.begin(), 1) - 1);
        piece_ = part.first_piece + index;
        if (motion_.is_screw())
            return;
        const double begin = part.times[index], duration = part.times[index + 1] - begin;
        const auto within = [&](double time) { return std::clamp((time - begin) / duration, 0.0, 1.0); };
        found_.tau = {within(found_.time.lower), within(found_.time.upper)};
    }

    [[nodiscard]] std::string head() const {
        const bool a = moving_.body().volume().is_solid(), b = fixed_.body().volume().is_solid();
        std::string text =
            "chasles certificate 1\nmoving" + body_line(moving_) + "fixed" + body_line(fixed_) + "solid ";
        text += a && b ? "both\n" : a ? "moving\n" : b ? "fixed\n" : "none\n";
        text += line("radius", {moving_.radius(), fixed_.radius()}) + line("margin", {options_.margin});
        text += motion_.lines();
        if (verdict_ == Verdict::clear)
            return text + "verdict clear\n";
        if (verdict_ == Verdict::contact_at_start)
            return text + "verdict start\n";
        return text + line("verdict contact " + std::to_string(piece_), {found_.tau.lower, found_.tau.upper});
    }
    [[nodiscard]] PieceOfBodies piece_of(std::size_t index) const {
        return {own_, other_, motion_.piece(index), reach_};
    }

    std::string outside() {
        const PieceOfBodies start = piece_of(0);
        std::string text;
        for (const bool of_moving : {true, false}) {
            if (!(of_moving ? fixed_ : moving_).body().volume().is_solid())
                continue;
            for (const auto& [face, corner] : corners_of_parts(of_moving ? moving_ : fixed_)) {
                throw_if_cancelled();
                const std::optional<Ray> ray = ray_from(start, of_moving, face, corner);
                if (ray && ray->winding <= 0)
                    text += "outside " + ray->words + "\n";
                else
                    miss("that no part of a body is inside of the other one at the start");
            }
        }
        return text;
    }
    std::string proof() {
        std::string text;
        std::size_t open = 0;
        for (std::size_t index = 0; index < motion_.piece_count() && index <= piece_; ++index) {
            const Proof proof = prove(piece_of(index), index == piece_ ? found_.tau.lower : 1);
            text += "proof " + std::to_string(index) + "\n" + proof.steps;
            result_.planes += proof.planes;
            open += proof.open;
        }
        if (open > 0)
            miss(std::to_string(open) + " steps, where the bodies are nearer to each other than planes can tell");
        return text;
    }
    std::string witness() {
        const std::size_t index = verdict_ == Verdict::contact_at_start ? 0 : piece_;
        const PieceOfBodies piece = piece_of(index);
        if (verdict_ == Verdict::contact_at_start && found_.inside)
            return witness_inside(piece);
        const double tau = verdict_ == Verdict::contact_at_start ? 0 : found_.tau.upper;
        if (const auto words = witness_at(piece, tau))
            return *words + "\n";
        miss("the contact: no edge was found that passes through a convex face");
        return "";
    }
    std::string witness_inside(const PieceOfBodies& piece) {
        const bool of_moving = found_.inside->moving_is_inside;
        const Polyhedron& body = of_moving ? moving_ : fixed_;
        for (const auto& [face, corner] : corners_of_parts(body))
            if (const auto ray = ray_from(piece, of_moving, face, corner); ray && ray->winding > 0)
                return "witness inside " + ray->words + "\n";
        miss("that a part of a body is inside of the other one");
        return "";
    }
    void miss(const std::string& what) {
        if (result_.missing.empty())
            result_.missing = "not proven: " + what;
    }

    Polyhedron moving_, fixed_;
    QueryOptions options_;
    CertifiedMotion motion_;
    FaceTree own_, other_;
    DoubleDouble reach_;
    FirstContact found_;
    Verdict verdict_ = Verdict::unknown;
    std::size_t piece_ = std::numeric_limits<std::size_t>::max(); ///< with the contact, if there is one
    Certificate result_;
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
    certificate::check_body(query.moving, "moving");
    certificate::check_body(query.fixed, "fixed");
    return certificate::Certifier(query).run();
}

bool is_about(const std::string& text, std::span<const Motion> path) {
    return text.find("\n" + certificate::CertifiedMotion(path).lines() + "verdict ") != std::string::npos;
}

} // namespace chasles
