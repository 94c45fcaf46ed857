// FirstContact.certificate and chasles.verify.
#include "chasles/certificate/certificate.h"

#include "chasles/base/invalid_input.h"
#include "python/src/answer.h"
#include "python/src/bind.h"
#include "python/src/signals.h"
#include "python/src/without_gil.h"
#include "tools/verify.h"

#include <nanobind/stl/string.h>
#include <sstream>

namespace chasles::python {

namespace nb = nanobind;

namespace {

std::string certificate_along(const Answer& answer, std::vector<Motion> path) {
    if (answer.is_swapped)
        throw InvalidInput("certificate: the bodies of this answer have swapped their roles; ask the answer before");
    const Polyhedron& moving = polyhedron_of(answer.moving, "moving");
    const Polyhedron& fixed = polyhedron_of(answer.fixed, "fixed");
    const WithoutGil without_gil;
    const EndsBySignals ends_by_signals;
    QueryOptions options;
    options.margin = answer.margin;
    options.hold = answer.hold;
    const Certificate certificate = certify(PathQuery{moving, fixed, std::move(path), options});
    if (!certificate.missing.empty())
        throw InvalidInput("certificate: " + certificate.missing);
    return certificate.text;
}

/// A motion, or a list of those of a path.
std::vector<Motion> path_from(nb::handle motion) {
    std::vector<Motion> path;
    if (!nb::isinstance<nb::list>(motion) && !nb::isinstance<nb::tuple>(motion))
        return {plain(given_motion(motion))};
    for (const nb::handle segment : motion)
        path.push_back(plain(given_motion(segment)));
    if (path.empty())
        throw InvalidInput("motion: the path has no motion");
    return path;
}

::certificate::Mesh mesh_of(const Polyhedron& body) {
    ::certificate::Mesh mesh;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        mesh.emplace_back();
        for (const std::uint32_t vertex : body.face(face)) {
            const Eigen::Vector3d& corner = body.vertices()[vertex];
            mesh.back().push_back({corner.x(), corner.y(), corner.z()});
        }
    }
    return mesh;
}

std::string verify(nb::handle moving, nb::handle fixed, nb::handle motion, const std::string& text) {
    const Polyhedron& moving_body = polyhedron_of(moving, "moving");
    const Polyhedron& fixed_body = polyhedron_of(fixed, "fixed");
    const std::vector<Motion> path = path_from(motion);
    const WithoutGil without_gil;
    if (!is_about(text, path))
        throw InvalidInput("verify: the certificate is about another motion");
    std::istringstream stream(text);
    const ::certificate::Verified verified = ::certificate::verify(mesh_of(moving_body), mesh_of(fixed_body), stream);
    if (!verified.holds)
        throw InvalidInput(verified.message);
    return verified.message;
}

} // namespace

std::string certificate_of(const Answer& answer) {
    return certificate_along(answer, {plain(answer.motion)});
}

std::string certificate_of_path(const PathAnswer& answer) {
    return certificate_along(answer, answer.path);
}

void bind_certificate(nb::module_& module) {
    using namespace nb::literals;
    module.def(
        "verify", verify, "moving"_a.none(), "fixed"_a.none(), "motion"_a.none(), "certificate"_a,
        "Does a certificate prove what it claims? In exact numbers, by the checker that shares nothing with the "
        "search.\n\n"
        "Parameters\n----------\nmoving, fixed : Polyhedron\n    The bodies that it has to be about.\n"
        "motion : Motion, or list of Motion\n    That it has to be about; of a path the motions of its "
        "segments.\ncertificate : str\n    What "
        "`FirstContact.certificate()` gave, or the text of a file of `chasles check --certificate`.\n\n"
        "Returns\n-------\nstr\n    What is proven, a claim a line.\n\nRaises\n------\nInvalidInput\n    Where it "
        "proves less, is about another motion or other bodies, or is damaged: with the reason.\n\n"
        "Source: docs/certificate.md.");
}

} // namespace chasles::python
