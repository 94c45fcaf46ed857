// A chain of even turns and slides, for planes that stand still: where a corner of the moving body is, and how its
// height changes. Source: docs/certificate.md, "Chains" and "Proof".
#pragma once

#include "chasles/algebra/sine_cosine.h"
#include "chasles/certificate/plane_form.h"

#include <ranges>
#include <utility>
#include <vector>

namespace chasles::certificate {

/// x -> A + S (R x + B) with A = place + tau travel, and S the turn about the unit vector `axis` by angle + tau rate;
/// or its inverse.
template <class S>
struct EvenLink {
    bool is_inverse = false;
    Matrix3<S> orientation = algebra::identity_matrix<S>(); ///< R
    Vector3<S> arm{};                                       ///< B
    Vector3<S> place{}, travel{}, axis{};
    S angle{}, rate{};

    [[nodiscard]] Vector3<S> place_at(const S& tau) const { return place + scale(travel, tau); }
    [[nodiscard]] Matrix3<S> turn_at(const S& tau) const {
        const auto [sine, cosine] = algebra::sine_cosine(S(angle + tau * rate));
        const Matrix3<S> across = cross_matrix(axis);
        return algebra::identity_matrix<S>() + scale(across, sine) + scale(across * across, S(S(1) - cosine));
    }
};

template <class S>
class ChainPiece {
public:
    /// The outermost link first.
    explicit ChainPiece(std::vector<EvenLink<S>> links) : links_(std::move(links)) {}

    [[nodiscard]] Vector3<S> place(const Corner& corner, const S& tau) const {
        const Map at = State(*this, tau, {}, 0).place;
        return at.linear * algebra::cast<S>(corner) + at.shift;
    }
    [[nodiscard]] Vector3<S> turned(const Vector3<S>& direction, const S& tau) const {
        return State(*this, tau, {}, 0).place.linear * direction;
    }
    /// By Taylor's formula about the middle of the cell: two rows, each twice.
    [[nodiscard]] PlaneForm<S> against(const Vector3<S>& normal, const S& offset, const Cell& cell,
                                       const Ball& node) const {
        const S half = (S(cell.upper) - S(cell.lower)) * S(0.5), middle = (S(cell.upper) + S(cell.lower)) * S(0.5);
        const double h = double(half);
        const State state(*this, middle, node, h);
        constexpr double up = 1 + 1e-9; // more than rounding
        const double bend = 0.5 * up * state.bound * h * h * (double(length(normal)) + 1);
        const Vector3<S> row = state.place.linear.transposed() * normal,
                         rate = scale(state.rate.linear.transposed() * normal, half);
        const S shift = dot(normal, state.place.shift) - offset - S(bend), way = half * dot(normal, state.rate.shift);
        return {{row + rate, row - rate, row + rate, row - rate}, {shift + way, shift - way, shift + way, shift - way}};
    }

private:
    /// Of a corner b: linear b + shift.
    struct Map {
        Matrix3<S> linear;
        Vector3<S> shift;
    };
    /// From the innermost link to the outermost.
    struct State {
        Map place{algebra::identity_matrix<S>(), {}}; ///< at tau
        Map rate{};                                   ///< there
        double bound = 0;                             ///< of |x''| for all corners in a ball, within h of tau

        State(const ChainPiece& chain, const S& tau, const Ball& node, double h) : node_(node), h_(h) {
            for (const EvenLink<S>& link : std::views::reverse(chain.links_))
                link.is_inverse ? go_back(link, tau) : go(link, tau);
        }

    private:
        void go(const EvenLink<S>& link, const S& tau) {
            turn(link.orientation);
            place.shift = place.shift + link.arm;
            turn(link, link.turn_at(tau), link.rate);
            place.shift = place.shift + link.place_at(tau);
            rate.shift = rate.shift + link.travel;
        }
        void go_back(const EvenLink<S>& link, const S& tau) {
            place.shift = place.shift - link.place_at(tau);
            rate.shift = rate.shift - link.travel;
            turn(link, link.turn_at(tau).transposed(), S(S(0) - link.rate));
            place.shift = place.shift - link.arm;
            turn(link.orientation.transposed());
        }
        void turn(const Matrix3<S>& by) {
            for (Map* const map : {&place, &rate})
                *map = {by * map->linear, by * map->shift};
        }
        void turn(const EvenLink<S>& link, const Matrix3<S>& by, const S& speed) {
            const double omega = std::abs(double(speed));
            const double fastest = size(rate) + spin_ * node_.radius + h_ * bound;
            const double farthest = size(place) + node_.radius + h_ * fastest;
            bound += omega * (2 * fastest + omega * farthest);
            spin_ += omega;
            const Vector3<S> turning = scale(link.axis, speed);
            rate.linear = rate.linear + cross_matrix(turning) * place.linear;
            rate.shift = rate.shift + cross(turning, place.shift);
            turn(by);
        }
        /// Of the value at the centre of the node.
        [[nodiscard]] double size(const Map& map) const {
            const Vector3<S> value = map.linear * algebra::cast<S>(node_.centre) + map.shift;
            return std::sqrt(double(dot(value, value)));
        }

        Ball node_;
        double h_;
        double spin_ = 0; ///< the sum of all angular speeds so far
    };

    std::vector<EvenLink<S>> links_;
};

} // namespace chasles::certificate
