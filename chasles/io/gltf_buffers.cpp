// Reads accessors of glTF. Every position in the bytes is checked against the length of its buffer.
// Source: glTF 2.0 specification, section 3.6, "Binary Data Storage".
#include "chasles/io/gltf_buffers.h"

#include "chasles/io/bytes.h"

#include <algorithm>
#include <array>
#include <limits>

namespace chasles::io {

// Where the numbers of an accessor lie.
struct GltfBuffers::Layout {
    std::size_t view = 0;
    std::size_t offset = 0;
    std::size_t component_type = 0;
    std::size_t components = 1;
    std::size_t count = 0;
    std::size_t stride = 0; ///< 0 if the elements follow each other
    bool is_normalized = false;
    std::string place;
};

namespace {

constexpr std::size_t most_sparse_elements = std::size_t{1} << 20U; ///< of an accessor without bytes of its own

std::size_t component_size(std::size_t type) {
    switch (type) {
    case 5120: // signed byte
    case 5121: // unsigned byte
        return 1;
    case 5122: // short
    case 5123: // unsigned short
        return 2;
    case 5125: // unsigned int
    case 5126: // float
        return 4;
    default:
        throw InvalidInput("componentType: " + std::to_string(type) + " is none of 5120 to 5123, 5125 and 5126");
    }
}

template <typename Number>
double gltf_component(std::string_view bytes, bool is_normalized) {
    const auto number = double(load<Number>(bytes, std::endian::little));
    return is_normalized ? std::max(number / double(std::numeric_limits<Number>::max()), -1.0) : number;
}

double gltf_component(std::size_t type, std::string_view bytes, bool is_normalized) {
    switch (type) {
    case 5120:
        return gltf_component<std::int8_t>(bytes, is_normalized);
    case 5121:
        return gltf_component<std::uint8_t>(bytes, is_normalized);
    case 5122:
        return gltf_component<std::int16_t>(bytes, is_normalized);
    case 5123:
        return gltf_component<std::uint16_t>(bytes, is_normalized);
    case 5125:
        return gltf_component<std::uint32_t>(bytes, is_normalized);
    default:
        return load<float>(bytes, std::endian::little);
    }
}

// The value of a digit, or -1.
int base64_digit(char c) {
    const std::size_t digit =
        std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
    return digit == std::string_view::npos ? -1 : int(digit);
}

std::string from_base64(std::string_view text) {
    std::array<int, 256> digits{};
    for (int c = 0; c < 256; ++c)
        digits[std::size_t(c)] = base64_digit(static_cast<char>(c));
    while (text.ends_with('='))
        text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const int digit = digits[static_cast<unsigned char>(c)];
        if (digit < 0)
            throw InvalidInput("uri: is no base64");
        bits = (bits << 6U) | static_cast<std::uint32_t>(digit);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<char>((bits >> unsigned(count)) & 0xffU));
        }
    }
    return bytes;
}

int hex_digit(char c) {
    const std::size_t digit = std::string_view("0123456789abcdef").find(lower_case(std::string_view(&c, 1)));
    return digit == std::string_view::npos ? -1 : int(digit);
}

// "a%20b" is "a b".
std::string percent_decoded(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool is_code =
            uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0;
        text.push_back(is_code ? static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2])) : uri[i]);
        i += is_code ? 2 : 0;
    }
    return text;
}

} // namespace

// What an accessor says about itself and its bufferView.
GltfBuffers::Layout GltfBuffers::layout_of(const GltfItem& item, std::string_view type) const {
    if (item.text("type") != type)
        item.fail("type: must be " + std::string(type) + ", not " + in_quotes(item.text("type")));
    Layout layout;
    layout.place = item.place;
    layout.offset = item.count("byteOffset", 0);
    layout.component_type = item.count("componentType");
    layout.components = type == "VEC3" ? 3 : 1;
    layout.count = item.count("count");
    layout.is_normalized = item.flag("normalized");
    if (item.find("bufferView")) {
        layout.view = item.count("bufferView");
        layout.stride = gltf_item(file_, "bufferView", layout.view).count("byteStride", 0);
    }
    return layout;
}

std::vector<double> GltfBuffers::numbers(std::size_t accessor, std::string_view type, SizeBudget& budget) {
    const GltfItem item = gltf_item(file_, "accessor", accessor);
    const Layout layout = layout_of(item, type);
    const bool has_bytes = item.find("bufferView");
    if (!has_bytes && !item.find("sparse"))
        item.fail("has neither bufferView nor sparse values");
    if (!has_bytes && layout.count > most_sparse_elements)
        item.fail("announces " + std::to_string(layout.count) + " elements, but has no bufferView");
    std::vector<double> numbers = has_bytes ? copy(layout) : std::vector<double>(layout.count * layout.components, 0.0);
    budget.spend(layout.count);
    if (item.find("sparse"))
        add_sparse(item, layout, numbers);
    return numbers;
}

// Refuses elements beyond the end of the bytes.
void GltfBuffers::check_room(const Layout& layout, std::size_t stride, std::size_t bytes) {
    const std::size_t element = component_size(layout.component_type) * layout.components;
    if (stride < element)
        throw InvalidInput(layout.place + ": the byteStride of its bufferView is shorter than one element");
    const bool has_room = layout.offset <= bytes &&
                          (layout.count == 0 || (bytes - layout.offset >= element &&
                                                 layout.count - 1 <= (bytes - layout.offset - element) / stride));
    if (!has_room)
        throw InvalidInput(layout.place + ": announces " + std::to_string(layout.count) +
                           " elements, which are more than its bufferView has");
}

// All numbers of the layout.
std::vector<double> GltfBuffers::copy(const Layout& layout) {
    const std::string_view bytes = view(layout.view);
    const std::size_t size = component_size(layout.component_type);
    const std::size_t stride = layout.stride == 0 ? size * layout.components : layout.stride;
    check_room(layout, stride, bytes.size());
    std::vector<double> numbers;
    numbers.reserve(layout.count * layout.components);
    for (std::size_t i = 0; i < layout.count; ++i)
        for (std::size_t k = 0; k < layout.components; ++k)
            numbers.push_back(gltf_component(layout.component_type, bytes.substr(layout.offset + i * stride + k * size),
                                             layout.is_normalized));
    return numbers;
}

// The indices or the values of a sparse accessor. They have the layout of `like`, elsewhere.
std::vector<double> GltfBuffers::sparse_part(const GltfItem& sparse, const char* key, Layout like) {
    const Json* const json = sparse.find(key);
    if (!json || !json->is_object())
        sparse.fail("needs indices and values");
    const GltfItem part{*json, sparse.place + " " + key};
    like.place = part.place;
    like.count = sparse.count("count");
    like.view = part.count("bufferView");
    like.offset = part.count("byteOffset", 0);
    like.stride = 0;
    like.component_type = part.count("componentType", like.component_type);
    return copy(like);
}

// Puts the values of the elements that the accessor lists in the place of the others.
void GltfBuffers::add_sparse(const GltfItem& accessor, const Layout& layout, std::vector<double>& numbers) {
    const GltfItem sparse{*accessor.find("sparse"), accessor.place + ": sparse"};
    Layout one_number = layout;
    one_number.components = 1;
    one_number.is_normalized = false;
    const std::vector<double> indices = sparse_part(sparse, "indices", one_number);
    const std::vector<double> values = sparse_part(sparse, "values", layout);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (!(indices[i] >= 0 && indices[i] < double(layout.count)))
            sparse.fail("an index is out of range");
        for (std::size_t k = 0; k < layout.components; ++k)
            numbers[std::size_t(indices[i]) * layout.components + k] = values[i * layout.components + k];
    }
}

std::string_view GltfBuffers::view(std::size_t index) {
    const GltfItem item = gltf_item(file_, "bufferView", index);
    for (const char* const extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        if (item.has_extension(extension))
            item.fail(std::string("is compressed (") + extension + "), which is not read; export without compression");
    const std::string_view bytes = buffer(item.count("buffer"));
    const std::size_t offset = item.count("byteOffset", 0), length = item.count("byteLength");
    if (offset > bytes.size() || length > bytes.size() - offset)
        item.fail("ends behind the end of its buffer of " + std::to_string(bytes.size()) + " bytes");
    return bytes.substr(offset, length);
}

std::string_view GltfBuffers::buffer(std::size_t index) {
    const GltfItem item = gltf_item(file_, "buffer", index);
    std::string_view bytes = binary_;
    if (item.find("uri")) {
        const auto [known, is_new] = buffers_.try_emplace(index);
        if (is_new)
            known->second = decoded_buffer(item);
        bytes = known->second;
    } else if (index != 0 || binary_.empty()) {
        item.fail("has no uri, and there is no binary chunk for it");
    }
    const std::size_t length = item.count("byteLength");
    if (length > bytes.size())
        item.fail("announces " + std::to_string(length) + " bytes, but there are " + std::to_string(bytes.size()));
    return bytes.substr(0, length);
}

// The bytes of a data URI or of a file beside this one.
std::string GltfBuffers::decoded_buffer(const GltfItem& item) const {
    const std::string uri = item.text("uri");
    if (uri.starts_with("data:")) {
        const std::size_t comma = uri.find(',');
        if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64"))
            item.fail("uri: only data in base64 is read");
        return from_base64(std::string_view(uri).substr(comma + 1));
    }
    if (uri.empty() || uri.find("://") != std::string::npos)
        item.fail("uri: " + in_quotes(uri) + " is no file; only files and embedded data are read");
    if (!file_beside_)
        item.fail("refers to the file " + in_quotes(uri) + "; embed the buffers, for example as GLB");
    return file_beside_(percent_decoded(uri));
}

} // namespace chasles::io
