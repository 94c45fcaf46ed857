// Writes the bytes of binary formats: numbers, base64, GLB and ZIP.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>
#include <zlib.h>

namespace chasles::tests {

/// The bytes of a number on machines with the low byte first.
template <typename Number>
std::string bytes_of(Number number) {
    const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    return {raw.begin(), raw.end()};
}

inline std::string base64(const std::string& bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
}

/// A GLB file of a JSON text and a binary chunk.
inline std::string glb(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const auto size = static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary.size());
    return "glTF" + bytes_of(std::uint32_t{2}) + bytes_of(size) + bytes_of(std::uint32_t(json.size())) + "JSON" + json +
           bytes_of(std::uint32_t(binary.size())) + std::string("BIN\0", 4) + binary;
}

/// Packs with deflate, without a header.
inline std::string deflated(const std::string& bytes) {
    std::string packed(compressBound(bytes.size()) + 64, '\0');
    z_stream stream{};
    deflateInit2(&stream, 9, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = uInt(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = uInt(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

/// A ZIP archive of entries with names; some are stored, some are packed.
inline std::string zip(const std::vector<std::pair<std::string, std::string>>& entries) {
    std::string archive, directory;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto& [name, content] = entries[i];
        const std::string packed = i % 2 == 0 ? deflated(content) : content;
        const auto crc = std::uint32_t(crc32(0, reinterpret_cast<const Bytef*>(content.data()), uInt(content.size())));
        const std::string common = bytes_of(std::uint16_t{20}) + bytes_of(std::uint16_t{0}) +
                                   bytes_of(std::uint16_t(i % 2 == 0 ? 8 : 0)) + std::string(4, '\0') + bytes_of(crc) +
                                   bytes_of(std::uint32_t(packed.size())) + bytes_of(std::uint32_t(content.size())) +
                                   bytes_of(std::uint16_t(name.size())) + bytes_of(std::uint16_t{0});
        directory += "PK\1\2" + bytes_of(std::uint16_t{20}) + common + std::string(10, '\0') +
                     bytes_of(std::uint32_t(archive.size())) + name;
        archive += "PK\3\4" + common + name + packed;
    }
    const auto count = std::uint16_t(entries.size());
    return archive + directory + "PK\5\6" + std::string(4, '\0') + bytes_of(count) + bytes_of(count) +
           bytes_of(std::uint32_t(directory.size())) + bytes_of(std::uint32_t(archive.size())) + std::string(2, '\0');
}

/// A 3MF file with this text of its model part, and other parts.
inline std::string threemf(const std::string& model, std::vector<std::pair<std::string, std::string>> others = {}) {
    others.insert(
        others.begin(),
        {{"[Content_Types].xml", "<Types/>"},
         {"_rels/.rels",
          R"(<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship )"
          R"(Target="/3D/3dmodel.model" Id="r" )"
          R"(Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)"},
         {"3D/3dmodel.model", model}});
    return zip(others);
}

} // namespace chasles::tests
