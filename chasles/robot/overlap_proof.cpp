#include "chasles/robot/overlap_proof.h"

#include "chasles/motion/screw_path.h"

namespace chasles::robot {

OverlapProof::OverlapProof(const Model& model, const std::vector<const Element*>& first,
                           const std::vector<const Element*>& second)
    : model_(model), first_(first), second_(second) {
    for (const Element* element : first_)
        of_first_.emplace_back(element->shape);
    for (const Element* element : second_)
        of_second_.emplace_back(element->shape);
}

bool OverlapProof::touch_within(double margin, const Configuration& configuration) const {
    const SegmentMotion motion = model_.motion_of({0, 1, configuration.transpose()});
    for (std::size_t i = 0; i < first_.size(); ++i)
        for (std::size_t k = 0; k < second_.size(); ++k) {
            const motion::SharedFrame frame =
                motion::chain_frame(model_.chain_between(motion, *second_[k], *first_[i]));
            const Eigen::Isometry3d relative =
                motion::rounded(frame->refined_at(algebra::DoubleDouble(0.0))).isometry();
            if (overlap_within(of_first_[i], of_second_[k], relative, {.way = margin}))
                return true;
        }
    return false;
}

} // namespace chasles::robot
