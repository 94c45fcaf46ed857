// What is proven about one pair of links. One joint is swept exactly; the others make boxes of configurations, in which
// no point of a link is farther from its place in the middle than a bound.
// Source: docs/derivations/29-robots.md, "Pairs that never touch".
#pragma once

#include "chasles/robot/overlap_proof.h"
#include "chasles/robot/pair_axes.h"
#include "chasles/robot/pair_proof.h"

#include <chrono>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

namespace chasles::robot {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class PairSearch {
public:
    /// Links by their index in the description. The robot and the options are kept by reference.
    PairSearch(const Robot& given, std::size_t first, std::size_t second, const PairProofOptions& options);

    /// The number of joints between the links: pairs with few are decided fast.
    [[nodiscard]] std::size_t dimension() const { return axes_.size(); }
    /// Whether more time may decide an open pair.
    [[nodiscard]] bool is_unfinished() const { return has_limits_ && (!may_touch_ || may_be_always()); }
    /// Ends soon after `goes_on` has returned false, which any one thread asks now and then; it may be empty.
    void run(PairProof& proof, double seconds, const std::function<bool()>& goes_on);

private:
    /// A box of configurations; `middle` and `half` are of each axis, or of each but the swept one.
    struct Cell {
        std::vector<double> middle;
        std::vector<double> half;
    };
    struct LineContact {
        std::optional<double> when = {};
        bool is_certain = false;
        bool starts_clear = true;
    };

    [[nodiscard]] bool may_be_always() const { return has_witness_ && !was_clear_; }
    [[nodiscard]] Configuration configuration(const std::vector<double>& values, double swept) const;
    [[nodiscard]] Configuration configuration(const std::vector<double>& values) const;
    [[nodiscard]] JointPath::Segment line(const std::vector<double>& values) const;
    template <class Use>
    void for_each_answer(const JointPath::Segment& segment, const QueryOptions& options, const Use& use) const;
    [[nodiscard]] bool come_near(const std::vector<double>& values, double margin) const;
    [[nodiscard]] LineContact first_contact_on(const std::vector<double>& values) const;
    [[nodiscard]] bool meet(const Configuration& values) const;
    [[nodiscard]] bool are_clear(const Configuration& values) const;
    void note(const std::vector<double>& values, PairProof& proof);
    void find_witness(const std::vector<double>& values, const LineContact& contact, PairProof& proof);
    void look_for_clear(const std::vector<double>& values, PairProof& proof);
    void try_clear(const Configuration& values, PairProof& proof);
    bool sample(PairProof& proof);
    bool decide(PairProof& proof) const;
    /// What holds in all configurations, if no cell stays open.
    struct Claim {
        PairReason reason;
        std::function<bool(const Cell&)> is_open; ///< not proven in the cell; called from several threads
        std::function<void(const Cell&)> look_at; ///< may find in an open cell that the claim is wrong
    };
    void search(PairProof& proof);
    void prove_never(PairProof& proof);
    void prove_always(PairProof& proof);
    void branch(PairProof& proof, std::size_t axes, const Claim& claim);
    bool examine(std::deque<Cell>& cells, PairProof& proof, const Claim& claim);
    [[nodiscard]] Cell whole(std::size_t axes) const;
    [[nodiscard]] std::vector<char> flags_of(const std::deque<Cell>& cells,
                                             const std::function<bool(const Cell&)>& is_flagged) const;
    [[nodiscard]] double margin_of(const Cell& cell) const;
    static void split(const std::vector<Axis>& axes, const Cell& cell, std::deque<Cell>& cells);

    const Model& model_;
    const PairProofOptions& options_;
    Configuration neutral_;
    std::vector<const Element*> first_, second_;
    std::vector<Axis> axes_; ///< the swept one last
    bool has_limits_ = true;
    bool was_clear_ = false;   ///< in some configuration
    bool may_touch_ = false;   ///< in some configuration, if only by rounding
    bool has_witness_ = false; ///< they touch in some configuration
};

} // namespace chasles::robot
