// chasles._core.scene_page and recording_page: pages of many bodies. python/chasles/record.py writes them to files.
#include "chasles/base/invalid_input.h"
#include "chasles/io/pose_text.h"
#include "python/src/bind.h"
#include "python/src/poses.h"
#include "python/src/scene.h"
#include "python/src/signals.h"
#include "python/src/without_gil.h"
#include "view/page.h"

#include <algorithm>
#include <fmt/format.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <set>

namespace chasles::python {
namespace {

using namespace nb::literals;

// --- An answered scene ---

/// Whether the scene is what it was at the question: a page draws its motions, and repeats what is proven about them.
void require_unchanged(const PythonScene& scene, std::uint64_t state_of_answer) {
    if (state_of_answer != scene.use.state())
        throw InvalidInput(
            "found: is the answer of another scene, or of this one before it was changed; ask this scene "
            "again, and show that answer");
}

/// The question that all entries of a list answer. Throws InvalidInput for a part of an answer: a page of it would say
/// that nothing else touches.
std::shared_ptr<const SceneQuestion> question_of(std::span<const SceneContactAnswer> list) {
    std::set<Names> pairs;
    const std::shared_ptr<const SceneQuestion> question = list.front().question;
    for (const SceneContactAnswer& answer : list) {
        if (!answer.question || answer.is_first || answer.question != question)
            throw InvalidInput("found: must be an answer of first_contact, or the list that all_contacts has given");
        pairs.insert(*answer.pair);
    }
    if (pairs.size() != question->contacts || list.size() != question->contacts)
        throw InvalidInput(
            fmt::format("found: has {} of the {} contacts that all_contacts has found; give its whole list",
                        pairs.size(), question->contacts));
    return question;
}

SceneContact contact_in(const Scene& scene, const Names& pair, const FirstContact& found) {
    return {scene.index_of(pair.first), scene.index_of(pair.second), found};
}

void add_to(SceneAnswer& found, const Scene& scene, const SceneContactAnswer& answer) {
    if (answer.pair)
        found.contacts.push_back(contact_in(scene, *answer.pair, answer.found));
    for (const NamedContact& other : answer.simultaneous)
        found.contacts.push_back(contact_in(scene, other.pair, other.found));
}

const SceneContactAnswer& scene_contact(nb::handle argument) {
    const SceneContactAnswer* contact = nullptr;
    if (!nb::try_cast(argument, contact) || !contact)
        throw nb::type_error("found: must be a chasles.SceneContact, a list of them, or a chasles.DistanceMatrix");
    return *contact;
}

bool is_list(nb::handle found) {
    return nb::isinstance<nb::list>(found) || nb::isinstance<nb::tuple>(found);
}

std::vector<SceneContactAnswer> answers_from(nb::handle found) {
    if (!is_list(found))
        return {scene_contact(found)};
    std::vector<SceneContactAnswer> answers;
    for (const nb::handle entry : found)
        answers.push_back(scene_contact(entry));
    return answers;
}

std::string matrix_page(const PythonScene& scene, const PythonMatrix& given, const std::string& title, bool curve) {
    require_unchanged(scene, given.scene);
    const WithoutGil without_gil;
    const EndsBySignals ends_by_signals;
    view::SceneRecord record = view::scene_record(scene.scene, given.found);
    if (curve)
        record.curve = view::curve_of(scene.scene, 0);
    record.title = title;
    return view::scene_page(record);
}

/// `found` is what first_contact, all_contacts or least_distances of the scene has returned.
std::string scene_page(const PythonScene& scene, nb::handle found, const std::string& title, bool curve) {
    const Asking asking = scene.asking();
    if (nb::isinstance<PythonMatrix>(found))
        return matrix_page(scene, nb::cast<const PythonMatrix&>(found), title, curve);
    const std::vector<SceneContactAnswer> given = answers_from(found);
    const bool is_first = given.size() == 1 && given.front().is_first && !is_list(found);
    const std::shared_ptr<const SceneQuestion> question = given.empty() ? scene.without_contacts
                                                          : is_first    ? given.front().question
                                                                        : question_of(given);
    if (!question)
        throw InvalidInput("found: is an empty list, but all_contacts of this scene has given none");
    require_unchanged(scene, question->scene);
    SceneAnswer answer;
    answer.verdict = is_first ? given.front().found.verdict : Verdict::clear; // of all pairs that are not listed
    answer.untested = is_first ? given.front().untested : scene.scene.untested({.until = question->until});
    for (const SceneContactAnswer& contact : given)
        add_to(answer, scene.scene, contact);
    const double margin = given.empty() ? question->margin : given.back().margin;
    const WithoutGil without_gil;
    const EndsBySignals ends_by_signals;
    view::SceneRecord record = view::scene_record(
        scene.scene, answer, is_first ? view::RecordSource::first_contact : view::RecordSource::all_contacts);
    if (curve)
        record.curve = view::curve_of(scene.scene, margin);
    record.title = title;
    record.margin = margin;
    record.until = question->until;
    record.clear_until.reset();
    if (is_first)
        record.clear_until = given.front().found.clear_until;
    return view::scene_page(record);
}

// --- A recording ---

std::vector<double> times_from(nb::handle argument) {
    const DoubleArray times(argument, "times");
    if (times.shape().size() != 1)
        throw InvalidInput("times: the shape is " + times.shape_text() + "; times have (n,)");
    return {times.numbers().begin(), times.numbers().end()};
}

/// One row if all poses are equal.
std::vector<view::PoseRow> rows_from(std::span<const double> numbers, std::size_t body, std::size_t bodies) {
    std::vector<Pose> poses;
    for (std::size_t at = 7 * body; at < numbers.size(); at += 7 * bodies)
        try {
            poses.push_back(io::pose_from_numbers(numbers.subspan(at, 7)));
        } catch (const InvalidInput& error) {
            throw InvalidInput(fmt::format("poses[{}, {}]: {}", poses.size(), body, error.what()));
        }
    std::vector<view::PoseRow> rows = view::pose_rows(poses);
    if (std::ranges::all_of(rows, [&](const view::PoseRow& row) { return row == rows.front(); }))
        rows.resize(std::min<std::size_t>(rows.size(), 1));
    return rows;
}

void add_bodies(view::SceneRecord& record, const std::vector<std::string>& names, nb::handle shapes, nb::handle poses) {
    const DoubleArray array(poses, "poses");
    const std::array<Py_ssize_t, 3> wanted{Py_ssize_t(record.times.size()), Py_ssize_t(names.size()), 7};
    if (!std::ranges::equal(array.shape(), wanted))
        throw InvalidInput(fmt::format("poses: the shape is {}; {} times and {} bodies need {}", array.shape_text(),
                                       wanted[0], wanted[1], text_of_shape(wanted)));
    for (std::size_t i = 0; i < names.size(); ++i)
        record.bodies.push_back({names[i], polyhedron_of(shapes[i], fmt::format("bodies[{}]", i).c_str()),
                                 rows_from(array.numbers(), i, names.size())});
}

/// Rows of three numbers. An array of shape (3,) is one row.
std::vector<Eigen::Vector3d> vectors_from(nb::handle argument, const std::string& name) {
    const DoubleArray array(argument, name);
    const auto shape = array.shape();
    const bool is_empty = array.numbers().empty();
    if (!is_empty && (shape.size() > 2 || shape.back() != 3))
        throw InvalidInput(name + ": the shape is " + array.shape_text() + "; vectors have (n, 3)");
    std::vector<Eigen::Vector3d> vectors;
    for (std::size_t at = 0; at + 2 < array.numbers().size(); at += 3)
        vectors.emplace_back(array.numbers()[at], array.numbers()[at + 1], array.numbers()[at + 2]);
    return vectors;
}

std::vector<Contact> points_from(nb::handle event, const std::string& where) {
    const std::vector<Eigen::Vector3d> points = vectors_from(event["points"], where + ": points");
    const std::vector<Eigen::Vector3d> normals = vectors_from(event["normals"], where + ": normals");
    const DoubleArray gaps(event["gaps"], where + ": gaps");
    const std::size_t gap_count = gaps.numbers().size();
    if (normals.size() != points.size() || (gap_count != 0 && gap_count != points.size()))
        throw InvalidInput(
            fmt::format("{}: {} points, {} normals and {} gaps", where, points.size(), normals.size(), gap_count));
    std::vector<Contact> contacts(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        contacts[i].point = points[i];
        contacts[i].normal = normals[i];
        contacts[i].gap = gap_count == 0 ? 0 : gaps.numbers()[i];
    }
    return contacts;
}

/// `event` is a dict that record.py has made.
view::RecordedContact event_from(nb::handle event, std::size_t index) {
    view::RecordedContact contact;
    contact.time = nb::cast<double>(event["time"]);
    contact.time_upper = nb::cast<double>(event["time_upper"]);
    contact.certain = nb::cast<bool>(event["certain"]);
    contact.moving = nb::cast<std::size_t>(event["moving"]);
    contact.fixed = nb::cast<std::size_t>(event["fixed"]);
    contact.kind = nb::cast<std::string>(event["kind"]);
    contact.contacts = points_from(event, fmt::format("contacts[{}]", index));
    contact.has_features = false;
    return contact;
}

std::string recording_page(const std::vector<std::string>& names, nb::list shapes, nb::handle times, nb::handle poses,
                           nb::list contacts, const std::string& title) {
    view::SceneRecord record;
    record.title = title;
    record.times = times_from(times);
    add_bodies(record, names, shapes, poses);
    for (std::size_t i = 0; i < contacts.size(); ++i)
        record.contacts.push_back(event_from(contacts[i], i));
    const WithoutGil without_gil;
    return view::scene_page(record);
}

} // namespace

void bind_record(nb::module_& module) {
    module.def("scene_page", scene_page, "scene"_a, "found"_a, "title"_a, "curve"_a,
               "A page of HTML in UTF-8 that shows an answered scene. The page needs no network.");
    module.def("recording_page", recording_page, "names"_a, "shapes"_a, "times"_a, "poses"_a, "contacts"_a, "title"_a,
               "A page of HTML in UTF-8 that shows a recording. The page needs no network.");
}

} // namespace chasles::python
