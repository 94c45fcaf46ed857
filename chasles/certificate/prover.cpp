#include "chasles/certificate/prover.h"

#include "chasles/base/limit_of_thread.h"

#include <cmath>

#include <vector>

namespace chasles::certificate {

namespace {

/// Cells are not halved more often: their ends are exact in double-double.
constexpr int most_halvings = 48;
/// A proof that needs more is left open.
constexpr std::size_t most_steps = 20'000'000;

struct Task {
    std::uint64_t number; ///< of the cell among those of its size
    int halvings;
    std::uint32_t moving, fixed; ///< nodes
    Corner hint;                 ///< along which a larger pair of nodes was apart
};

class Prover {
public:
    Prover(const PieceOfBodies& piece, double end) : piece_(piece), end_(end) {}

    Proof run() {
        waiting_.push_back({0, 0, 0, 0, {}});
        while (!waiting_.empty()) {
            const Task task = waiting_.back();
            waiting_.pop_back();
            if (watch_.is_over(1))
                throw Cancelled();
            step(task);
        }
        return std::move(proof_);
    }

private:
    using Node = FaceTree::Node;

    [[nodiscard]] Cell cell_of(const Task& task) const {
        const double part = std::ldexp(1.0, -task.halvings);
        return {DoubleDouble(end_) * DoubleDouble(double(task.number) * part),
                DoubleDouble(end_) * DoubleDouble(double(task.number + 1) * part)};
    }
    void step(const Task& task) {
        const Node &a = piece_.moving().node(task.moving), &b = piece_.fixed().node(task.fixed);
        NotSeparated why;
        if (const auto normal = piece_.separate(a, b, cell_of(task), task.hint, why)) {
            proof_.steps += "P " + words_of(*normal) + "\n";
            ++proof_.planes;
            return;
        }
        divide(task, a, b, why);
    }
    /// Nodes that are larger than what the motion moves them are divided before the cell is.
    void divide(const Task& task, const Node& a, const Node& b, const NotSeparated& why) {
        const bool first_is_larger = b.is_leaf() || (!a.is_leaf() && a.extent >= b.extent);
        const Node& larger = first_is_larger ? a : b;
        const bool by_time = larger.is_leaf() || (!why.overlap && why.loss > larger.extent);
        if (by_time && (task.halvings == most_halvings || proof_.planes + waiting_.size() > most_steps)) {
            proof_.steps += "?\n";
            ++proof_.open;
            return;
        }
        Task first = task, second = task;
        if (by_time) {
            first.number = 2 * task.number;
            second.number = first.number + 1;
            ++first.halvings;
            ++second.halvings;
        } else if (first_is_larger) {
            first.moving = a.parts;
            second.moving = a.parts + 1;
        } else {
            first.fixed = b.parts;
            second.fixed = b.parts + 1;
        }
        proof_.steps += by_time ? "T " : first_is_larger ? "A " : "B ";
        waiting_.push_back(second);
        waiting_.push_back(first);
    }

    const PieceOfBodies& piece_;
    double end_;
    Proof proof_;
    std::vector<Task> waiting_;
    Watch watch_;
};

} // namespace

Proof prove(const PieceOfBodies& piece, double end) {
    return Prover(piece, end).run();
}

} // namespace chasles::certificate
