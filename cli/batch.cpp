// chasles batch: many motions of one pair of bodies, on all cores. The rows of a chunk are written as soon as all its
// motions are answered. After Ctrl-C, or when the time is over, --resume goes on from there.
#include "chasles/base/invalid_input.h"
#include "chasles/io/csv_table.h"
#include "chasles/io/motion_files.h"
#include "chasles/io/text_scan.h"
#include "cli/batch_certificates.h"
#include "cli/batch_rows.h"
#include "cli/commands.h"
#include "cli/interruption.h"
#include "cli/motion_rule.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/warnings.h"
#include "view/names.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/format.h>
#include <memory>
#include <span>
#include <string_view>
#include <thread>

namespace chasles::cli {
namespace {

/// Motions per write to the file. A chunk takes a fraction of a second where motions take less than that, and is enough
/// to keep all cores busy: slow rows are written as soon as they are answered.
class ChunkSize {
public:
    [[nodiscard]] std::size_t get() const { return size_; }
    void adapt(std::chrono::duration<double> last) {
        if (last.count() < 0.1)
            size_ = std::min<std::size_t>(2 * size_, 1024);
        else if (last.count() > 0.4)
            size_ = std::max<std::size_t>(size_ / 2, std::max(1U, std::thread::hardware_concurrency()));
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
    std::string certificates; ///< folder; empty: none
    bool resume = false;
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

/// A row whose motion no question takes is in error, as one that cannot be read.
void mark_refused(std::vector<io::MotionRow>& rows, const Bodies& bodies, const MotionRule& rule) {
    for (io::MotionRow& row : rows)
        try {
            if (row.error.empty())
                check_motion(bodies.moving, bodies.fixed, motion_between(rule, row.start, row.goal));
        } catch (const InvalidInput& error) {
            row.error = fmt::format("row {}: {}", io::one_line(row.id), error.what());
        }
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

// The rows of one chunk, up to the first that was not answered in time. `answers` belong to its readable motions, in
// order.
std::string table_of(Rows rows, std::span<const FirstContact> answers, view::MotionKind kind, Tally& tally) {
    std::string table;
    for (const io::MotionRow& row : rows) {
        const FirstContact* const found = row.error.empty() ? &answers.front() : nullptr;
        if (found && found->verdict == Verdict::unknown)
            break;
        table += found ? batch_row(row.id, *found, kind) : batch_error_row(row.id, row.error);
        count(tally, row, found);
        if (found)
            answers = answers.subspan(1);
    }
    return table;
}

/// Counts a row that was answered before. False if the line is no answer to the motion of the row.
bool count_kept(const io::MotionRow& row, std::string_view line, Tally& tally) {
    const std::string start = io::csv_cell(row.id) + ",";
    if (!line.starts_with(start))
        return false;
    line.remove_prefix(start.size());
    const std::string_view name = line.substr(0, line.find(','));
    for (const Verdict verdict : {Verdict::clear, Verdict::contact, Verdict::contact_at_start})
        if (row.error.empty() && name == view::name_of(verdict))
            return ++tally.verdicts[static_cast<std::size_t>(verdict)] > 0;
    if (row.error.empty() || name != "error")
        return false;
    count(tally, row, nullptr);
    return true;
}

/// The lines of a text that end, with their ends.
std::vector<std::string_view> whole_lines(std::string_view text) {
    std::vector<std::string_view> lines;
    for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
        lines.push_back(text.substr(0, end + 1));
        text.remove_prefix(end + 1);
    }
    return lines;
}

/// The first line, the last one and a few contacts: lines about clear motions are the same for many questions.
std::vector<std::size_t> lines_to_answer_again(std::span<const std::string_view> lines) {
    constexpr std::size_t most_contacts_checked = 8;
    std::vector<std::size_t> chosen;
    if (lines.size() > 1)
        chosen = {1, lines.size() - 1};
    for (std::size_t i = 1; i < lines.size() && chosen.size() < 2 + most_contacts_checked; ++i)
        if (lines[i].find(",contact") != std::string_view::npos)
            chosen.push_back(i);
    return chosen;
}

/// Answers the motions in chunks and writes each chunk at once.
class BatchRun {
public:
    BatchRun(const BatchOptions& options, std::vector<io::MotionRow>& rows)
        : rows_(rows), bodies_(load_bodies(options.bodies)), query_(options_of(options.query)),
          rule_(rule_of(options.motion)), seconds_(seconds_of(options.query.seconds)),
          threads_(options.bodies.polyhedron.threads),
          out_(options.out, options.resume ? Leftover::continued : Leftover::refused),
          certificates_(options.certificates) {
        print_warnings(bodies_.warnings);
        mark_refused(rows, bodies_, rule_);
    }

    /// All rows, or those before an interruption.
    Tally run() {
        ProgressBar bar("motions", rows_.size());
        ChunkSize size;
        Tally tally = keep_rows();
        const Limit limit(seconds_, [] { return !Interruption::is_requested(); });
        out_.write(tally.rows() == 0 ? batch_header() : "");
        out_.keep_rows();
        while (tally.rows() < rows_.size() && !limit.is_over()) {
            const auto start = std::chrono::steady_clock::now();
            const std::size_t done = tally.rows();
            const Rows chunk = rows_.subspan(done, std::min(size.get(), rows_.size() - done));
            Tally next = tally;
            const std::string table = table_of(chunk, next, [&](std::size_t n) { bar.show(done + n); });
            if (!certify(chunk.first(next.rows() - done), done))
                break; // a row that is written has its certificate
            out_.write(table);
            tally = next;
            size.adapt(std::chrono::steady_clock::now() - start);
        }
        if (tally.rows() == rows_.size())
            out_.close();
        return tally;
    }
    [[nodiscard]] std::string rows_name() const { return out_.rows_name(); }
    [[nodiscard]] const BatchCertificates& certificates() const { return certificates_; }

private:
    /// `done` rows come before the first of these.
    bool certify(Rows rows, std::size_t done) {
        const std::vector<Motion> motions = readable_motions(rows, rule_);
        std::vector<std::size_t> numbers;
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (rows[i].error.empty())
                numbers.push_back(done + i + 1);
        return certificates_.write(question(motions), numbers);
    }
    [[nodiscard]] BatchQuery question(std::span<const Motion> motions,
                                      std::function<void(std::size_t)> progress = {}) const {
        return {.moving = bodies_.moving,
                .fixed = bodies_.fixed,
                .motions = motions,
                .options = query_,
                .batch = {.threads = threads_, .progress = std::move(progress)}};
    }
    /// The rows of one chunk.
    std::string table_of(Rows chunk, Tally& tally, std::function<void(std::size_t)> progress = {}) const {
        const std::vector<Motion> motions = readable_motions(chunk, rule_);
        const auto answers = first_contact_batch(question(motions, std::move(progress)));
        return cli::table_of(chunk, answers, rule_.kind, tally);
    }

    /// Counts the rows that a run before has left, and goes on after the last whole one. Some of them are answered once
    /// more: the same text shows that they belong to this question.
    Tally keep_rows() {
        const std::string text = out_.kept_rows();
        const std::vector<std::string_view> lines = whole_lines(text);
        Tally tally;
        std::size_t bytes = 0;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (i == 0 ? lines[i] != batch_header() : i > rows_.size() || !count_kept(rows_[i - 1], lines[i], tally))
                refuse_rows(i);
            bytes += lines[i].size();
        }
        for (const std::size_t i : lines_to_answer_again(lines))
            if (Tally again; table_of(rows_.subspan(i - 1, 1), again) != lines[i])
                refuse_rows(i);
        out_.continue_after(tally.rows() == 0 ? 0 : bytes);
        return tally;
    }
    [[noreturn]] void refuse_rows(std::size_t line) const {
        throw InvalidInput(fmt::format("{}: line {}: answers another question than this; remove the file to begin anew",
                                       io::one_line(out_.rows_name()), line + 1));
    }

    Rows rows_;
    Bodies bodies_;
    QueryOptions query_;
    MotionRule rule_;
    double seconds_; ///< for all motions
    unsigned threads_;
    OutputFile out_; // opened only after all other input has been read
    BatchCertificates certificates_;
};

/// Interrupted, or out of time.
int report_unfinished(const std::string& what) {
    if (Interruption::is_requested())
        return report_interruption(what);
    std::fputs(("chasles: the time was over: " + what + "\n").c_str(), stderr);
    return is_unknown;
}

int run_batch(const BatchOptions& options) {
    io::MotionList motions = io::load_motions(options.motions);
    print_warnings(motions.warnings);
    std::vector<io::MotionRow>& rows = motions.rows;
    const Interruption interruption;
    BatchRun batch(options, rows);
    const Tally tally = batch.run();
    if (tally.rows() < rows.size())
        return report_unfinished(fmt::format("{} of {} are answered, in {}{}", tally.rows(),
                                             counted(rows.size(), "motion"), io::one_line(batch.rows_name()),
                                             batch.rows_name() == options.out ? "" : "; --resume goes on from there"));
    if (!is_standard_output(options.out))
        print(fmt::format("{}: {} clear, {} in contact, {} in contact at the start, {}\n",
                          counted(tally.rows(), "motion"), tally.of(Verdict::clear), tally.of(Verdict::contact),
                          tally.of(Verdict::contact_at_start), counted(tally.errors, "error")));
    if (const std::string missing = batch.certificates().missing(); !missing.empty())
        std::fputs(("chasles: " + missing + "\n").c_str(), stderr);
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
    command
        .add_option("--certificates", options->certificates,
                    "write a proof of each row into this folder, as ROW.cert, for chasles verify")
        ->type_name("FOLDER");
    command.add_flag("--resume", options->resume, "go on from the rows that a run that was cut has left in FILE.part");
    command.add_option("--threads", options->bodies.polyhedron.threads, "number of threads; 0 for all cores")
        ->capture_default_str();
    add_motion_rule_options(command, options->motion);
    add_batch_query_options(command, options->query);
    command.callback([options, &task] { task = [options] { return run_batch(*options); }; });
}

} // namespace chasles::cli
