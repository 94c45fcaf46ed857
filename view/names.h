// Names of the enumerators in files and in Python.
#pragma once

#include "chasles/query/first_contact.h"
#include "chasles/robot/pair_proof.h"
#include "chasles/robot/range.h"
#include "view/motion_numbers.h"
#include "view/scene_record.h"

#include <string_view>

namespace chasles::view {

/// The name of the C++ enumerator, for example "contact_at_start".
std::string_view name_of(Verdict verdict);
std::string_view name_of(ContactKind kind);
std::string_view name_of(MotionKind kind);
std::string_view name_of(RecordSource source);
std::string_view name_of(PairReason reason);
std::string_view name_of(RangeVerdict verdict);
std::string_view name_of(UntestedReason reason);
std::string_view name_of(JointType type);

} // namespace chasles::view
