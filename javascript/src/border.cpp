// The buffers. Their sizes are known on this side, so that a wrong count from JavaScript cannot reach beyond them.
#include "javascript/src/border.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace chasles::javascript {
namespace {

std::vector<double>& numbers() {
    static std::vector<double> given;
    return given;
}

std::string& bytes() {
    static std::string given;
    return given;
}

std::array<char, 2048>& text() {
    static std::array<char, 2048> kept{};
    return kept;
}

/// Gives a buffer this size. Returns its address, or 0 if it does not fit into memory.
template <typename Buffer>
std::int32_t resized(Buffer& buffer, std::uint32_t size) noexcept {
    constexpr std::size_t worth_keeping = 1 << 20; // larger buffers are for one mesh, and freed with the next argument
    try {
        if (buffer.capacity() > worth_keeping && size < buffer.capacity() / 2)
            Buffer().swap(buffer);
        buffer.resize(size);
        return static_cast<std::int32_t>(reinterpret_cast<std::uintptr_t>(buffer.data()));
    } catch (const std::exception&) {
        return 0;
    }
}

} // namespace

std::span<const double> given_numbers() {
    return numbers();
}

std::string_view given_bytes() {
    return bytes();
}

std::vector<double>& answer_numbers() {
    static std::vector<double> answer;
    return answer;
}

void keep_text(const char* given) noexcept {
    const std::size_t length = std::min(std::strlen(given), text().size() - 1);
    std::copy_n(given, length, text().begin());
    text()[length] = '\0';
}

} // namespace chasles::javascript

namespace js = chasles::javascript;

/// Room for `count` doubles, and for `count` bytes: the address, or 0 if memory is short.
CHASLES_JAVASCRIPT(numbers)(std::uint32_t count) {
    return js::resized(js::numbers(), count);
}
CHASLES_JAVASCRIPT(bytes)(std::uint32_t count) {
    return js::resized(js::bytes(), count);
}

/// The address of the answer, and that of the text, which ends with a zero.
CHASLES_JAVASCRIPT(answer)() {
    return static_cast<std::int32_t>(reinterpret_cast<std::uintptr_t>(js::answer_numbers().data()));
}
CHASLES_JAVASCRIPT(text)() {
    return static_cast<std::int32_t>(reinterpret_cast<std::uintptr_t>(js::text().data()));
}
