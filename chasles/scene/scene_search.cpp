// Asks the pairs of a scene, several at a time. Answers do not depend on the number of threads: pairs are taken in
// rounds whose sizes are fixed, and what one pair is asked depends on earlier rounds only. Source:
// docs/derivations/27-scenes.md, "Order".
#include "chasles/base/limit_of_thread.h"
#include "chasles/base/parallel_for.h"
#include "chasles/base/sort.h"
#include "chasles/query/pair_query.h"
#include "chasles/query/requirements.h"
#include "chasles/scene/pair_question.h"
#include "chasles/scene/pair_tasks.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <numeric>
#include <tuple>

namespace chasles {

namespace {

using scene::PairTask;

/// The tasks of a search, in rounds of sizes that grow: later rounds find less.
class Rounds {
public:
    explicit Rounds(std::size_t tasks) : tasks_(tasks) {}

    [[nodiscard]] bool is_over() const { return begin_ >= tasks_; }
    [[nodiscard]] std::size_t begin() const { return begin_; }
    [[nodiscard]] std::size_t end() const { return std::min(begin_ + size_, tasks_); }
    void next() {
        constexpr std::size_t largest = 4096;
        begin_ = end();
        size_ = std::min(2 * size_, largest);
    }

private:
    std::size_t tasks_;
    std::size_t begin_ = 0;
    std::size_t size_ = 64;
};

void check(const Scene& scene, const SceneQuery& query) {
    query::check_options(query.options, scene.margins(query.options.margin).upper);
    query::require(query.until >= 0 && query.until <= 1, "until", "must be in [0, 1]");
}

class SceneSearch {
public:
    SceneSearch(const Scene& world, const SceneQuery& query)
        : scene_(world), query_(query), tasks_(scene::pair_tasks(world, query)) {}

    SceneAnswer earliest();
    SceneAnswer any();
    SceneAnswer all();
    /// What `ask` returns. At the limit it is `unknown`, with the time until which the scene is proven clear.
    template <class Ask>
    SceneAnswer within_limit(const Ask& ask);

private:
    [[nodiscard]] FirstContact ask(const scene::IndexPair& pair, double until) const;
    /// Asks the tasks of a round, and returns the contacts in the order of the tasks.
    std::vector<SceneContact> ask_all(const Rounds& rounds, double until);
    void report_progress();
    [[nodiscard]] std::vector<SceneContact> sorted(std::vector<SceneContact> contacts) const;
    [[nodiscard]] SceneAnswer answer(std::vector<SceneContact> contacts) const;

    const Scene& scene_;
    const SceneQuery& query_;
    std::vector<PairTask> tasks_;
    Mutex reporting_;
    std::size_t done_ = 0;
    std::atomic<bool> is_cancelled_ = false;
    double clear_until_ = 0; ///< proven while rounds go on
    double first_contact_ = 1;
    Work work_;
};

FirstContact SceneSearch::ask(const scene::IndexPair& pair, double until) const {
    const QueryOptions options = scene_.options_of(pair.first, pair.second, query_.options);
    return scene::first_contact_of(scene::mover(scene_, pair.first), scene::mover(scene_, pair.second), options, until);
}

std::vector<SceneContact> SceneSearch::ask_all(const Rounds& rounds, double until) {
    std::vector<SceneContact> answers(rounds.end() - rounds.begin());
    clear_until_ = std::min(first_contact_, tasks_[rounds.begin()].earliest);
    parallel_for(query_.threads, answers.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && !is_cancelled_; ++i) {
            const PairTask& task = tasks_[rounds.begin() + i];
            answers[i] = {task.pair.first, task.pair.second, ask(task.pair, until)};
            report_progress();
        }
    });
    if (is_cancelled_)
        throw Cancelled();
    for (const SceneContact& answer : answers)
        work_ += answer.contact.work;
    std::erase_if(answers, [](const SceneContact& c) { return c.contact.verdict == Verdict::clear; });
    for (const SceneContact& answer : answers)
        first_contact_ = std::min(first_contact_, answer.contact.clear_until);
    return answers;
}

void SceneSearch::report_progress() {
    if (!query_.progress)
        return;
    const Lock lock(reporting_);
    ++done_;
    if (!is_cancelled_ && !query_.progress(done_, tasks_.size()))
        is_cancelled_ = true;
}

/// In order of time, and of names where brackets are equal.
std::vector<SceneContact> SceneSearch::sorted(std::vector<SceneContact> contacts) const {
    const auto key = [&](std::size_t i) {
        const SceneContact& c = contacts[i];
        return std::tuple(c.contact.time.lower, c.contact.time.upper, scene::names_of(scene_, {c.moving, c.fixed}));
    };
    std::vector<std::size_t> order(contacts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    chasles::sort(order, {}, key);
    std::vector<SceneContact> sorted;
    for (const std::size_t i : order)
        sorted.push_back(std::move(contacts[i]));
    return sorted;
}

SceneAnswer SceneSearch::answer(std::vector<SceneContact> contacts) const {
    SceneAnswer answer;
    answer.contacts = sorted(std::move(contacts));
    answer.verdict = answer.contacts.empty() ? Verdict::clear : answer.contacts.front().contact.verdict;
    answer.clear_until = query_.until;
    for (const SceneContact& contact : answer.contacts)
        answer.clear_until = std::min(answer.clear_until, contact.contact.clear_until);
    answer.pairs = tasks_.size();
    answer.work = work_;
    return answer;
}

SceneAnswer SceneSearch::earliest() {
    std::vector<SceneContact> found;
    std::size_t unlimited = 0; // so many of them were asked without a limit
    double best = query_.until;
    const double slack = 4 * query_.options.time_tolerance; // brackets found with a limit may differ a little
    const bool wants_all = query_.options.find == Find::first_with_all_contacts;
    const auto may_be_earlier = [&](double time) { return time <= best && (best > 0 || wants_all || found.empty()); };
    for (Rounds rounds(tasks_.size()); !rounds.is_over() && may_be_earlier(tasks_[rounds.begin()].earliest);
         rounds.next()) {
        const bool has_limit = !found.empty();
        for (SceneContact& contact : ask_all(rounds, best)) {
            const double end = contact.contact.time.upper;
            best = std::min(best, end > 0 ? end + slack : 0);
            found.push_back(std::move(contact));
        }
        unlimited = has_limit ? unlimited : found.size();
    }
    // A limit depends on other pairs, and a bracket must not. Contacts that may be the first get their brackets without
    // one.
    for (std::size_t i = unlimited; i < found.size(); ++i)
        if (SceneContact& contact = found[i]; contact.contact.time.lower <= best)
            contact.contact = ask({contact.moving, contact.fixed}, query_.until);
    std::erase_if(found, [&](const SceneContact& c) { return c.contact.time.lower > best; });
    SceneAnswer result = answer(std::move(found));
    if (!result.contacts.empty()) {
        const double end = result.contacts.front().contact.time.upper;
        std::erase_if(result.contacts, [&](const SceneContact& c) { return c.contact.time.lower > end; });
        result.clear_until = std::min(result.clear_until, end); // others were asked about no later time
    }
    return result;
}

SceneAnswer SceneSearch::any() {
    for (Rounds rounds(tasks_.size()); !rounds.is_over(); rounds.next())
        if (std::vector<SceneContact> found = ask_all(rounds, query_.until); !found.empty()) {
            found.resize(1);
            SceneAnswer some = answer(std::move(found));
            some.clear_until = std::min(some.clear_until, tasks_.front().earliest);
            return some;
        }
    return answer({});
}

SceneAnswer SceneSearch::all() {
    std::vector<SceneContact> found;
    for (Rounds rounds(tasks_.size()); !rounds.is_over(); rounds.next())
        std::ranges::move(ask_all(rounds, query_.until), std::back_inserter(found));
    return answer(std::move(found));
}

template <class Ask>
SceneAnswer SceneSearch::within_limit(const Ask& ask) {
    try {
        return ask();
    } catch (const Cancelled&) {
        SceneAnswer unknown;
        unknown.clear_until = std::min(clear_until_, query_.until);
        unknown.pairs = tasks_.size();
        unknown.work = work_;
        return unknown;
    }
}

} // namespace

SceneAnswer Scene::first_contact(const SceneQuery& query) const {
    check(*this, query);
    SceneSearch search(*this, query);
    SceneAnswer answer =
        search.within_limit([&] { return query.options.find == Find::any ? search.any() : search.earliest(); });
    answer.untested = numbers_of_untested(query);
    return answer;
}

SceneAnswer Scene::all_contacts(const SceneQuery& query) const {
    check(*this, query);
    query::require(
        query.options.find != Find::any, "find",
        "any asks whether anything touches, and this lists all that does: leave it out, or ask for the first contact");
    SceneSearch search(*this, query);
    SceneAnswer answer = search.within_limit([&] { return search.all(); });
    answer.untested = numbers_of_untested(query);
    return answer;
}

std::vector<double> Scene::clear_until(const SceneQuery& query) const {
    const SceneAnswer found = all_contacts(query);
    std::vector<double> clear(bodies_.size(), found.verdict == Verdict::unknown ? found.clear_until : query.until);
    for (const SceneContact& contact : found.contacts)
        for (const std::size_t body : {contact.moving, contact.fixed})
            clear[body] = std::min(clear[body], contact.contact.clear_until);
    return clear;
}

} // namespace chasles
