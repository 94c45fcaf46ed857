// The border between JavaScript and the library: functions that take and return whole numbers, two buffers for arguments
// and one for answers. No exception and no bad handle crosses it.
#pragma once

#include "chasles/base/invalid_input.h"

#include <cstdint>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// A function that JavaScript calls as `chasles_NAME`.
#define CHASLES_JAVASCRIPT(name) extern "C" __attribute__((export_name("chasles_" #name))) std::int32_t chasles_##name

namespace chasles::javascript {

/// What a function returns in the place of a count or a handle, which are never negative.
inline constexpr std::int32_t refused = -1;       ///< InvalidInput; the text says why
inline constexpr std::int32_t out_of_memory = -2; ///< nothing has changed
inline constexpr std::int32_t failed = -3;        ///< another exception, which is a fault of the library

/// The arguments, as JavaScript wrote them.
std::span<const double> given_numbers();
std::string_view given_bytes();

/// The numbers of the answer, for a function to fill.
std::vector<double>& answer_numbers();

/// Keeps the text of a failure, without allocating.
void keep_text(const char* text) noexcept;

/// `work()`, which returns a count or a handle; exceptions become the numbers above.
template <typename Work>
std::int32_t guarded(const Work& work) noexcept {
    try {
        answer_numbers().clear();
        return static_cast<std::int32_t>(work());
    } catch (const InvalidInput& error) {
        keep_text(error.what());
        return refused;
    } catch (const std::bad_alloc&) {
        keep_text("out of memory");
        return out_of_memory;
    } catch (const std::exception& error) {
        keep_text(error.what());
        return failed;
    }
}

/// `work()`, which fills the answer. Returns the number of its numbers.
template <typename Work>
std::int32_t answered(const Work& work) noexcept {
    return guarded([&] {
        work(answer_numbers());
        return answer_numbers().size();
    });
}

} // namespace chasles::javascript
