// chasles batch: many motions of one pair of bodies, on all cores. The rows of a chunk are written as soon as all its
// motions are answered. After Ctrl-C the current chunk is finished and written.
#include "chasles/io/motion_files.h"
#include "chasles/io/text_scan.h"
#include "cli/batch_rows.h"
#include "cli/commands.h"
#include "cli/interruption.h"
#include "cli/motion_rule.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/warnings.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <span>

namespace chasles::cli {
namespace {

/// Motions per write to the file. A chunk takes a fraction of a second where motions take less than that: enough to
/// keep all cores busy, and little to wait for after Ctrl-C.
class ChunkSize {
public:
    [[nodiscard]] std::size_t get() const { return size_; }
    void adapt(std::chrono::duration<double> last) {
        if (last.count() < 0.1)
            size_ = std::min<std::size_t>(2 * size_, 1024);
        else if (last.count() > 0.4)
            size_ = std::max<std::size_t>(size_ / 2, 16);
    }

private:
    std::size_t size_ = 64;
};

struct BatchOptions {
    BodyOptions bodies;
    QuestionOptions query;
    MotionOptions motion;
    std::string motions;
    std::string out;
};

/// The number of rows with each outcome.
struct Tally {
    std::array<std::size_t, 4> verdicts{}; ///< by Verdict
    std::size_t errors = 0;
    std::string first_error;

    [[nodiscard]] std::size_t of(Verdict verdict) const { return verdicts[static_cast<std::size_t>(verdict)]; }
    [[nodiscard]] std::size_t rows() const {
        return of(Verdict::clear) + of(Verdict::contact) + of(Verdict::contact_at_start) + errors;
    }
};

using Rows = std::span<const io::MotionRow>;

std::vector<Motion> readable_motions(Rows rows, const MotionRule& rule) {
    std::vector<Motion> motions;
    for (const io::MotionRow& row : rows)
        if (row.error.empty())
            motions.push_back(motion_between(rule, row.start, row.goal));
    return motions;
}

void count(Tally& tally, const io::MotionRow& row, const FirstContact* found) {
    if (found) {
        ++tally.verdicts[static_cast<std::size_t>(found->verdict)];
        return;
    }
    if (tally.errors == 0)
        tally.first_error = row.error;
    ++tally.errors;
}

// The rows of one chunk. `answers` belong to its readable motions, in order.
std::string table_of(Rows rows, std::span<const FirstContact> answers, view::MotionKind kind, Tally& tally) {
    std::string table;
    for (const io::MotionRow& row : rows) {
        const FirstContact* const found = row.error.empty() ? &answers.front() : nullptr;
        table += found ? batch_row(row.id, *found, kind) : batch_error_row(row.id, row.error);
        count(tally, row, found);
        if (found)
            answers = answers.subspan(1);
    }
    return table;
}

// Writing replaces the content of the output file, which therefore must not be an input.
void check_out_is_no_input(const BatchOptions& options) {
    for (const std::string& input : {options.motions, options.bodies.moving, options.bodies.fixed}) {
        std::error_code ignored;
        if (std::filesystem::equivalent(options.out, input, ignored))
            throw InvalidInput("--out: " + options.out + ": is an input of this command");
    }
}

/// Answers the motions in chunks and writes each chunk at once.
class BatchRun {
public:
    BatchRun(const BatchOptions& options, Rows rows)
        : rows_(rows), bodies_(load_bodies(options.bodies)), query_(options_of(options.query)),
          rule_(rule_of(options.motion, options.query)), threads_(options.bodies.polyhedron.threads),
          out_(options.out) {}

    /// All rows, or those before an interruption.
    Tally run() {
        Tally tally;
        ProgressBar bar("motions", rows_.size());
        ChunkSize size;
        std::string table = batch_header();
        while (tally.rows() < rows_.size() && !Interruption::is_requested()) {
            const auto start = std::chrono::steady_clock::now();
            const std::size_t done = tally.rows();
            const Rows chunk = rows_.subspan(done, std::min(size.get(), rows_.size() - done));
            const auto answers = answer(readable_motions(chunk, rule_), [&](std::size_t n) { bar.show(done + n); });
            out_.write(table + table_of(chunk, answers, rule_.kind, tally));
            table.clear();
            size.adapt(std::chrono::steady_clock::now() - start);
        }
        out_.write(table); // the header alone, if there was no row
        out_.close();
        return tally;
    }

private:
    std::vector<FirstContact> answer(const std::vector<Motion>& motions,
                                     std::function<void(std::size_t)> progress) const {
        return first_contact_batch({.moving = bodies_.moving,
                                    .fixed = bodies_.fixed,
                                    .motions = motions,
                                    .options = query_,
                                    .batch = {.threads = threads_, .progress = std::move(progress)}});
    }

    Rows rows_;
    Bodies bodies_;
    QueryOptions query_;
    MotionRule rule_;
    unsigned threads_;
    OutputFile out_; // last: opened only after all other input has been read
};

int report_interruption(const std::string& out, std::size_t answered, std::size_t rows) {
    const std::string message = fmt::format("chasles: interrupted: {} of {} are answered, in {}\n", answered,
                                            counted(rows, "motion"), io::one_line(out));
    std::fputs(message.c_str(), stderr);
    return is_interrupted;
}

int run_batch(const BatchOptions& options) {
    check_out_is_no_input(options);
    const io::MotionList motions = io::load_motions(options.motions);
    print_warnings(motions.warnings);
    const std::vector<io::MotionRow>& rows = motions.rows;
    const Interruption interruption;
    const Tally tally = BatchRun(options, rows).run();
    if (!is_standard_output(options.out))
        print(fmt::format("{}: {} clear, {} in contact, {} in contact at the start, {}\n",
                          counted(tally.rows(), "motion"), tally.of(Verdict::clear), tally.of(Verdict::contact),
                          tally.of(Verdict::contact_at_start), counted(tally.errors, "error")));
    if (tally.rows() < rows.size())
        return report_interruption(options.out, tally.rows(), rows.size());
    if (tally.errors > 0)
        throw InvalidInput(fmt::format("{}: {} of {} rows cannot be read; the first: {}", options.motions, tally.errors,
                                       rows.size(), tally.first_error));
    return tally.of(Verdict::clear) == rows.size() ? is_clear : is_contact;
}

} // namespace

void add_batch(CLI::App& app, Task& task) {
    const auto options = std::make_shared<BatchOptions>();
    CLI::App& command = *app.add_subcommand("batch", "Answers many motions of one pair of bodies, on all cores.");
    add_body_options(command, options->bodies);
    command
        .add_option("--motions", options->motions,
                    "table, one motion a row, with the columns x0,...,qz0,x1,...,qz1 in any order, and perhaps id")
        ->required()
        ->type_name("FILE");
    command.add_option("--out", options->out, "CSV file to write, one answer a row")->required()->type_name("FILE");
    command.add_option("--threads", options->bodies.polyhedron.threads, "number of threads; 0 for all cores")
        ->capture_default_str();
    add_motion_rule_options(command, options->motion);
    add_batch_query_options(command, options->query);
    command.callback([options, &task] { task = [options] { return run_batch(*options); }; });
}

} // namespace chasles::cli
