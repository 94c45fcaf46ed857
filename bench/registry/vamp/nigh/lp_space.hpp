// See nigh_forward.hpp.
#pragma once
#include <nigh/nigh_forward.hpp>
