#include "chasles/robot/overlap_proof.h"

#include "chasles/motion/screw_path.h"
#include "chasles/robot/small_motions.h"

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
    const SmallMotion motion_within{.rest_of_moving = margin, .rest_of_fixed = margin};
    const SegmentMotion motion = model_.motion_of({0, 1, configuration.transpose()});
    for (std::size_t i = 0; i < first_.size(); ++i)
        for (std::size_t k = 0; k < second_.size(); ++k) {
            const motion::SharedFrame frame =
                motion::chain_frame(model_.chain_between(motion, *second_[k], *first_[i]));
            const Eigen::Isometry3d relative =
                motion::rounded(frame->refined_at(algebra::DoubleDouble(0.0))).isometry();
            if (stay_in_touch({of_first_[i], of_second_[k], relative, motion_within}))
                return true;
        }
    return false;
}

} // namespace chasles::robot
