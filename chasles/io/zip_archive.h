// Reads entries of ZIP archives, of which 3MF files are made. zlib unpacks them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace chasles::io {

/// The entries of an archive. The bytes must outlive it.
class ZipArchive {
public:
    /// Reads the directory at the end of the archive. Throws InvalidInput if there is none.
    explicit ZipArchive(std::string_view bytes);

    /// Names do not distinguish capitals, as in all packages of OPC (Open Packaging Conventions).
    [[nodiscard]] bool has(std::string_view name) const;

    /// The unpacked entry. Throws InvalidInput if the entry does not exist, is encrypted, is packed by another method
    /// than deflate, or is damaged. All entries together may have 512 MiB, and 100 times the size of the archive plus
    /// 16 MiB.
    [[nodiscard]] std::string read(std::string_view name);

private:
    struct Entry {
        std::uint64_t flags = 0;
        std::uint64_t method = 0;
        std::uint64_t crc = 0;
        std::uint64_t packed_size = 0;
        std::uint64_t size = 0;
        std::uint64_t local_header = 0;
    };

    void read_directory(std::uint64_t position, std::uint64_t count);
    std::string_view packed_bytes(const Entry& entry) const;
    void check(const Entry& entry) const;
    std::string unpacked(const Entry& entry) const;

    std::string_view bytes_;
    std::map<std::string, Entry> entries_;
    std::uint64_t bytes_left_;
};

} // namespace chasles::io
