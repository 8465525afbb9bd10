// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// What the file formats share: voxel types as files have them, reading a known number of voxel bytes (plain
// or deflated), and making a Volume of what was read. Private to io.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/load.h"

namespace pellucid::io {

/// The number types of files; the 64-bit integers become narrower ones in a Volume.
enum class StoredType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };

[[nodiscard]] std::size_t bytesPerComponent(StoredType type);
/// "int8" ... "float64".
[[nodiscard]] const char* name(StoredType type);
[[nodiscard]] std::optional<StoredType> storedTypeFromName(std::string_view name);

/// Bytes of all voxels. Errors: Corrupt for a size below 1, TooLarge above `maxBytes` or beyond 64 bits.
[[nodiscard]] Result<std::uint64_t> voxelBytes(glm::ivec3 size, int components, StoredType type,
                                               std::uint64_t maxBytes);
/// "64x64x93 voxels x 1 component x 2 bytes (int16)", for messages.
[[nodiscard]] std::string arithmetic(glm::ivec3 size, int components, StoredType type);

/// Where voxels lie in a file.
struct VoxelSource {
    std::filesystem::path file;
    bool deflated = false;          ///< gzip or zlib from `skip` on.
    std::uint64_t skip = 0;         ///< Bytes of the file before the data.
    std::uint64_t skipDecoded = 0;  ///< Bytes of the decompressed stream before the voxels.
    bool countsFromEnd = false;  ///< The voxels are the last bytes of the (plain) file; `skip` is not used.
};

struct VoxelBytes {
    std::vector<std::byte> bytes;  ///< Exactly as many as asked.
    std::uint64_t surplus = 0;     ///< Bytes that follow in the file or stream.
};

/// Reads exactly `wanted` bytes. Nothing is allocated unless the file can hold them: a deflated file is taken
/// to expand at most 1032 times (zlib technical details, "maximum compression factor"). Errors: NotFound,
/// Unreadable, Corrupt (expected and found bytes; `what` is the arithmetic), Cancelled.
[[nodiscard]] Result<VoxelBytes> readVoxels(const VoxelSource& source, std::uint64_t wanted,
                                            const std::string& what, const Progress& progress);

/// Size of a regular file. Errors: NotFound, Unreadable (a folder, a device, a pipe: those have no size and
/// may never end).
[[nodiscard]] Result<std::uint64_t> regularFileSize(const std::filesystem::path& file);
/// Up to `count` bytes from the start, decompressed when the file is gzip. An unreadable file gives none.
[[nodiscard]] std::string firstBytes(const std::filesystem::path& file, std::size_t count, bool gunzip);
[[nodiscard]] bool isGzip(std::string_view start);

/// All that a format reader found out.
struct VolumeParts {
    std::string format;    ///< "NRRD 4, attached": for the facts.
    std::string encoding;  ///< "gzip", "raw, big endian".
    Grid grid;
    StoredType type = StoredType::UInt8;
    int components = 1;
    std::vector<std::byte> voxels;  ///< In the byte order `bigEndian`, components of a voxel together.
    bool bigEndian = false;
    ValueMapping mapping;
    VolumeInfo info;
};

/// Byte order, narrowing of 64-bit integers (with a warning that gives the worst error), facts, Volume::make.
[[nodiscard]] Result<VolumePtr> assemble(VolumeParts parts);

/// From one whole volume per component (component slowest) to components together.
[[nodiscard]] std::vector<std::byte> interleaved(std::span<const std::byte> planar, int components,
                                                 std::size_t bytesPerComponent);

}  // namespace pellucid::io
