// Reads the directory of a ZIP archive and unpacks its entries.
// Source: PKWARE, "APPNOTE.TXT - .ZIP File Format Specification", 6.3, with the 64-bit sizes of section 4.5.3.
#include "chasles/io/zip_archive.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/bytes.h"
#include "chasles/io/text_scan.h"

#include <zlib.h>

#include <algorithm>
#include <limits>

namespace chasles::io {
namespace {

constexpr std::uint64_t most_unpacked = std::uint64_t{512} << 20U;
constexpr std::uint64_t always_unpacked = std::uint64_t{16} << 20U;
constexpr std::uint64_t highest_ratio = 100;

constexpr std::uint64_t stored = 0; ///< methods of packing
constexpr std::uint64_t deflated = 8;

constexpr std::uint32_t entry_signature = 0x02014b50;
constexpr std::uint32_t local_signature = 0x04034b50;
constexpr std::uint32_t end_signature = 0x06054b50;
constexpr std::uint32_t end64_signature = 0x06064b50;
constexpr std::uint32_t locator_signature = 0x07064b50;
constexpr std::uint64_t in_64_bits = 0xFFFFFFFF; ///< stands for a number that follows in 64 bits

// The part of the bytes, which must be there.
std::string_view zip_part(std::string_view bytes, std::uint64_t position, std::uint64_t size) {
    if (position > bytes.size() || size > bytes.size() - position)
        throw InvalidInput("is no whole ZIP archive: it is truncated or damaged");
    return bytes.substr(position, size);
}

template <typename Number>
std::uint64_t zip_number(std::string_view bytes, std::uint64_t position) {
    return load<Number>(zip_part(bytes, position, sizeof(Number)), std::endian::little);
}

// Where the record is that ends every archive. A comment of up to 65,535 bytes may follow it.
std::uint64_t end_record(std::string_view bytes) {
    constexpr std::uint64_t record = 22, longest_comment = 65'535;
    for (std::uint64_t back = record; back <= std::min<std::uint64_t>(bytes.size(), record + longest_comment); ++back)
        if (zip_number<std::uint32_t>(bytes, bytes.size() - back) == end_signature)
            return bytes.size() - back;
    throw InvalidInput("is no ZIP archive, or is truncated: has no directory at its end");
}

// The sizes and the position that do not fit 32 bits are in an extra field, in this order.
void read_64_bits(std::string_view extra, std::initializer_list<std::uint64_t*> numbers) {
    while (extra.size() >= 4) {
        const std::uint64_t id = zip_number<std::uint16_t>(extra, 0), size = zip_number<std::uint16_t>(extra, 2);
        std::string_view field = zip_part(extra, 4, size);
        extra.remove_prefix(4 + size);
        if (id != 1)
            continue;
        for (std::uint64_t* const number : numbers)
            if (*number == in_64_bits) {
                *number = zip_number<std::uint64_t>(field, 0);
                field.remove_prefix(8);
            }
    }
}

// The name by which entries are found.
std::string zip_name(std::string_view name) {
    if (name.starts_with('/'))
        name.remove_prefix(1);
    std::string lower = lower_case(name);
    std::ranges::replace(lower, '\\', '/');
    return lower;
}

// Ends an unpacking.
struct Inflation {
    z_stream stream{};
    Inflation() {
        if (inflateInit2(&stream, -MAX_WBITS) != Z_OK)
            throw std::bad_alloc();
    }
    ~Inflation() { inflateEnd(&stream); }
    Inflation(const Inflation&) = delete;
    Inflation& operator=(const Inflation&) = delete;
};

// Unpacks as many bytes as the directory announces. The buffer grows with what is unpacked.
std::string inflated(std::string_view packed, std::uint64_t size) {
    constexpr std::size_t step = 1 << 20;
    Inflation inflation;
    z_stream& stream = inflation.stream;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data())); // zlib does not write to it
    stream.avail_in = static_cast<uInt>(packed.size());
    std::string bytes;
    int status = Z_OK;
    while (status == Z_OK && bytes.size() <= size) {
        const std::size_t before = bytes.size();
        bytes.resize(before + step);
        stream.next_out = reinterpret_cast<Bytef*>(bytes.data() + before);
        stream.avail_out = step;
        status = inflate(&stream, Z_NO_FLUSH);
        bytes.resize(before + step - stream.avail_out);
    }
    if (status != Z_STREAM_END || bytes.size() != size)
        throw InvalidInput("cannot be unpacked: it is damaged");
    return bytes;
}

} // namespace

ZipArchive::ZipArchive(std::string_view bytes)
    : bytes_(bytes),
      bytes_left_(std::min<std::uint64_t>(most_unpacked, highest_ratio * bytes.size() + always_unpacked)) {
    const std::uint64_t end = end_record(bytes);
    std::uint64_t count = zip_number<std::uint16_t>(bytes, end + 10);
    std::uint64_t position = zip_number<std::uint32_t>(bytes, end + 16);
    if (end >= 20 && zip_number<std::uint32_t>(bytes, end - 20) == locator_signature) {
        const std::uint64_t end64 = zip_number<std::uint64_t>(bytes, end - 12);
        if (zip_number<std::uint32_t>(bytes, end64) == end64_signature) {
            count = zip_number<std::uint64_t>(bytes, end64 + 32);
            position = zip_number<std::uint64_t>(bytes, end64 + 48);
        }
    }
    read_directory(position, count);
}

// Each entry takes 46 bytes at least, so that the file bounds the count.
void ZipArchive::read_directory(std::uint64_t position, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::string_view header = zip_part(bytes_, position, 46);
        if (zip_number<std::uint32_t>(header, 0) != entry_signature)
            throw InvalidInput("is no whole ZIP archive: its directory is damaged");
        const std::uint64_t name_size = zip_number<std::uint16_t>(header, 28),
                            extra_size = zip_number<std::uint16_t>(header, 30),
                            comment_size = zip_number<std::uint16_t>(header, 32);
        Entry entry;
        entry.flags = zip_number<std::uint16_t>(header, 8);
        entry.method = zip_number<std::uint16_t>(header, 10);
        entry.crc = zip_number<std::uint32_t>(header, 16);
        entry.packed_size = zip_number<std::uint32_t>(header, 20);
        entry.size = zip_number<std::uint32_t>(header, 24);
        entry.local_header = zip_number<std::uint32_t>(header, 42);
        read_64_bits(zip_part(bytes_, position + 46 + name_size, extra_size),
                     {&entry.size, &entry.packed_size, &entry.local_header});
        entries_.try_emplace(zip_name(zip_part(bytes_, position + 46, name_size)), entry);
        position += 46 + name_size + extra_size + comment_size;
    }
}

bool ZipArchive::has(std::string_view name) const {
    return entries_.contains(zip_name(name));
}

// The header before the entry repeats the name and may have another extra field than the directory.
std::string_view ZipArchive::packed_bytes(const Entry& entry) const {
    const std::string_view header = zip_part(bytes_, entry.local_header, 30);
    if (zip_number<std::uint32_t>(header, 0) != local_signature)
        throw InvalidInput("is damaged");
    const std::uint64_t skipped = 30 + zip_number<std::uint16_t>(header, 26) + zip_number<std::uint16_t>(header, 28);
    return zip_part(bytes_, entry.local_header + skipped, entry.packed_size);
}

// Refuses what cannot be unpacked, or what would take too much memory.
void ZipArchive::check(const Entry& entry) const {
    if ((entry.flags & 1U) != 0)
        throw InvalidInput("is encrypted");
    if (entry.method != stored && entry.method != deflated)
        throw InvalidInput("is packed by method " + std::to_string(entry.method) + "; only deflate is read");
    if (entry.size > bytes_left_)
        throw InvalidInput("is too large when it is unpacked: all parts together may have 512 MiB, and 100 times the "
                           "size of the file plus 16 MiB");
}

std::string ZipArchive::unpacked(const Entry& entry) const {
    check(entry);
    const std::string_view packed = packed_bytes(entry);
    if (packed.size() > std::numeric_limits<uInt>::max() || (entry.method == stored && packed.size() != entry.size))
        throw InvalidInput("is damaged");
    std::string content = entry.method == stored ? std::string(packed) : inflated(packed, entry.size);
    if (crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())) != entry.crc)
        throw InvalidInput("is damaged: its checksum is wrong");
    return content;
}

std::string ZipArchive::read(std::string_view name) {
    const auto found = entries_.find(zip_name(name));
    if (found == entries_.end())
        throw InvalidInput("has no part " + in_quotes(name));
    try {
        std::string content = unpacked(found->second);
        bytes_left_ -= content.size();
        return content;
    } catch (const InvalidInput& error) {
        throw InvalidInput("part " + in_quotes(name) + ": " + error.what());
    }
}

} // namespace chasles::io
