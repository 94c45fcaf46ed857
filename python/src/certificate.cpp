// FirstContact.certificate and chasles.verify; those of scenes and robots.
#include "python/src/certificate.h"

#include "chasles/base/invalid_input.h"
#include "chasles/certificate/certificate.h"
#include "python/src/answer.h"
#include "python/src/bind.h"
#include "python/src/signals.h"
#include "python/src/without_gil.h"
#include "tools/verify.h"

#include <algorithm>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <sstream>

namespace chasles::python {

namespace nb = nanobind;

namespace {

std::string text_of(const Certificate& certificate) {
    if (!certificate.missing.empty())
        throw InvalidInput("certificate: " + certificate.missing);
    return certificate.text;
}

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
    return text_of(certify(PathQuery{moving, fixed, std::move(path), options}));
}

/// A motion, or a list of those of a path.
std::vector<Motion> motions_from(nb::handle motion) {
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

/// What is proven about these bodies. Throws InvalidInput with the reason if nothing is.
std::string proven(const std::vector<::certificate::Mesh>& meshes, const std::string& text) {
    std::istringstream stream(text);
    const ::certificate::Verified verified = ::certificate::verify(meshes, stream);
    if (!verified.holds)
        throw InvalidInput(verified.message);
    return verified.message;
}

std::string verify(nb::handle moving, nb::handle fixed, nb::handle motion, const std::string& text) {
    const Polyhedron& moving_body = polyhedron_of(moving, "moving");
    const Polyhedron& fixed_body = polyhedron_of(fixed, "fixed");
    const std::vector<Motion> path = motions_from(motion);
    const WithoutGil without_gil;
    if (!is_about(text, path))
        throw InvalidInput("verify: the certificate is about another motion");
    return proven({mesh_of(moving_body), mesh_of(fixed_body)}, text);
}

/// The texts, and what each does not prove.
std::vector<std::pair<std::string, std::string>> certificate_batch(nb::handle moving, nb::handle fixed,
                                                                   nb::handle given, double margin, unsigned threads) {
    const Polyhedron& moving_body = polyhedron_of(moving, "moving");
    const Polyhedron& fixed_body = polyhedron_of(fixed, "fixed");
    std::vector<Motion> motions;
    for (const nb::handle motion : given)
        motions.push_back(plain(given_motion(motion)));
    const std::vector<Certificate> proofs = asked([&] {
        return certify_batch({.moving = moving_body,
                              .fixed = fixed_body,
                              .motions = motions,
                              .options = {.margin = margin},
                              .batch = {.threads = threads}});
    });
    std::vector<std::pair<std::string, std::string>> texts;
    for (const Certificate& proof : proofs)
        texts.emplace_back(proof.text, proof.missing);
    return texts;
}

/// Adds a mesh that is none of the others.
void add_mesh(std::vector<::certificate::Mesh>& meshes, const Polyhedron& body) {
    ::certificate::Mesh mesh = mesh_of(body);
    if (std::ranges::find(meshes, mesh) == meshes.end())
        meshes.push_back(std::move(mesh));
}

std::string certificate_of_scene(const PythonScene& scene, double margin) {
    const Asking question = scene.asking();
    SceneQuery query;
    query.options.margin = margin;
    return asked([&] { return text_of(certify(scene.scene, query)); });
}

std::string verify_scene(const PythonScene& scene, const std::string& text, double margin) {
    const Asking question = scene.asking();
    SceneQuery query;
    query.options.margin = margin;
    return asked([&] {
        if (!is_about(text, scene.scene, query))
            throw InvalidInput("verify: the certificate is about another scene or another margin");
        std::vector<::certificate::Mesh> meshes;
        for (const SceneBody& body : scene.scene.bodies())
            add_mesh(meshes, body.shape);
        return proven(meshes, text);
    });
}

std::string certificate_of_robot(const RobotChecker& checker, nb::handle configurations) {
    const JointPath path = path_from(checker.robot(), {configurations, nb::none(), nb::none(), nb::none()});
    return asked([&] { return text_of(certify(checker, path)); });
}

std::string verify_robot(const RobotChecker& checker, nb::handle configurations, const std::string& text) {
    const JointPath path = path_from(checker.robot(), {configurations, nb::none(), nb::none(), nb::none()});
    return asked([&] {
        if (!is_about(text, checker, path))
            throw InvalidInput("verify: the certificate is about another robot, scene, path or margin");
        std::vector<::certificate::Mesh> meshes;
        for (const Polyhedron& body : bodies_of(checker))
            add_mesh(meshes, body);
        return proven(meshes, text);
    });
}

#define CHASLES_VERIFY_DOC                                                                                             \
    "\n\nReturns\n-------\nstr\n    What is proven, a claim a line.\n\nRaises\n------\nInvalidInput\n"                 \
    "    Where it proves less, is about another question, or is damaged: with the reason.\n\n"                         \
    "Source: docs/certificate.md, \"Scenes\"."

} // namespace

void bind_certificates(nb::class_<PythonScene>& scene) {
    using namespace nb::literals;
    scene
        .def(
            "certificate", certificate_of_scene, nb::kw_only(), "margin"_a = 0.0,
            nb::sig("def certificate(self, *, margin: float = 0.0) -> str"),
            "A proof of what `first_contact` answers, with all tested pairs, as text that programs of others can check "
            "(docs/certificate.md, \"Scenes\"). Motions are velocities, twists, even hinges and sliders, `TimedPoses` "
            "with the same stamps, and products of these.\n\nReturns\n-------\nstr\n\nRaises\n------\nInvalidInput\n"
            "    For what cannot be certified, or is not proven: with the reason.")
        .def("verify", verify_scene, "certificate"_a, nb::kw_only(), "margin"_a = 0.0,
             nb::sig("def verify(self, certificate: str, *, margin: float = 0.0) -> str"),
             "Does a certificate prove what it claims, and is it about this scene? In exact numbers, by the checker "
             "that shares nothing with the search." CHASLES_VERIFY_DOC);
}

void bind_certificates(nb::class_<RobotChecker>& checker) {
    using namespace nb::literals;
    checker
        .def(
            "certificate", certificate_of_robot, "configurations"_a.none(),
            nb::sig("def certificate(self, configurations: numpy.typing.ArrayLike | JointPath) -> str"),
            "A proof of what `first_contact_on_path` answers for a path that is straight in joint space, with all "
            "tested pairs, as text that programs of others can check (docs/certificate.md, \"Scenes\"). Poses of links "
            "and axes are rounded to double. No handovers.\n\nReturns\n-------\nstr\n\nRaises\n------\nInvalidInput\n"
            "    For what cannot be certified, or is not proven: with the reason.")
        .def("verify", verify_robot, "configurations"_a.none(), "certificate"_a,
             nb::sig("def verify(self, configurations: numpy.typing.ArrayLike | JointPath, certificate: str) -> str"),
             "Does a certificate prove what it claims, and is it about this robot, its scene and this path? In exact "
             "numbers, by the checker that shares nothing with the search." CHASLES_VERIFY_DOC);
}

std::string certificate_of(const Answer& answer) {
    return certificate_along(answer, {plain(answer.motion)});
}

std::string certificate_of_path(const PathAnswer& answer) {
    return certificate_along(answer, answer.path);
}

void bind_certificate(nb::module_& module) {
    using namespace nb::literals;
    module.def("_certificate_batch", certificate_batch, "moving"_a.none(), "fixed"_a.none(), "motions"_a, "margin"_a,
               "threads"_a);
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
