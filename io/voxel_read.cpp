// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <zlib.h>

#include <cstring>
#include <fstream>
#include <functional>

#include "io/text_scan.h"
#include "io/voxel_data.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;

/// zlib technical details: "the maximum compression factor" is 1032:1.
constexpr std::uint64_t kDeflateMax = 1032;
constexpr std::size_t kPiece = 1 << 20;

/// Pulls decompressed bytes from a gzip (several members allowed) or zlib stream in a file.
class Inflater {
public:
    explicit Inflater(std::istream& stream) : m_stream(stream), m_in(kPiece) {
        // 15 window bits, + 32: gzip or zlib by its header.
        m_ready = inflateInit2(&m_z, 15 + 32) == Z_OK;
    }
    ~Inflater() {
        if (m_ready) inflateEnd(&m_z);
    }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    /// Up to `count` bytes; fewer only at the end of the stream or where it is damaged (then problem() says
    /// so).
    std::size_t read(std::byte* out, std::size_t count) {
        std::size_t done = 0;
        while (done < count && !m_ended && m_problem.empty()) done += step(out + done, count - done);
        return done;
    }
    [[nodiscard]] const std::string& problem() const { return m_problem; }
    [[nodiscard]] bool ended() const { return m_ended; }

private:
    void refill() {
        m_stream.read(reinterpret_cast<char*>(m_in.data()), static_cast<std::streamsize>(m_in.size()));
        m_z.next_in = reinterpret_cast<Bytef*>(m_in.data());
        m_z.avail_in = static_cast<uInt>(m_stream.gcount());
    }

    std::size_t step(std::byte* out, std::size_t count) {
        if (!m_ready) {
            m_problem = "zlib could not start";
            return 0;
        }
        if (m_z.avail_in == 0) refill();
        if (m_z.avail_in == 0) {
            m_problem = "the compressed data is cut off";
            return 0;
        }
        const uInt room = static_cast<uInt>(std::min<std::size_t>(count, 1u << 30));
        m_z.next_out = reinterpret_cast<Bytef*>(out);
        m_z.avail_out = room;
        const int status = inflate(&m_z, Z_NO_FLUSH);
        if (status == Z_STREAM_END) {
            endOfMember();
        } else if (status != Z_OK && status != Z_BUF_ERROR) {
            m_problem = fmt::format("the compressed data is damaged ({})",
                                    m_z.msg != nullptr ? m_z.msg : "zlib error");
        }
        return room - m_z.avail_out;
    }

    /// gzip files may be several members one after the other (RFC 1952, 2.2); anything else after the end is
    /// not ours.
    void endOfMember() {
        if (m_z.avail_in < 2) {
            std::memmove(m_in.data(), m_z.next_in, m_z.avail_in);
            const std::size_t kept = m_z.avail_in;
            m_stream.read(reinterpret_cast<char*>(m_in.data() + kept),
                          static_cast<std::streamsize>(m_in.size() - kept));
            m_z.next_in = reinterpret_cast<Bytef*>(m_in.data());
            m_z.avail_in = static_cast<uInt>(kept + static_cast<std::size_t>(m_stream.gcount()));
        }
        if (m_z.avail_in >= 2 && m_z.next_in[0] == 0x1f && m_z.next_in[1] == 0x8b) {
            inflateReset(&m_z);
        } else {
            m_ended = true;
        }
    }

    std::istream& m_stream;
    std::vector<std::byte> m_in;
    z_stream m_z{};
    bool m_ready = false;
    bool m_ended = false;
    std::string m_problem;
};

using Pull = std::function<std::size_t(std::byte*, std::size_t)>;

tl::unexpected<Error> tooShort(const std::string& what, std::uint64_t wanted, std::uint64_t found,
                               const std::string& because) {
    return fail(ErrorCode::Corrupt, fmt::format("expected {} = {} bytes of voxels, found {} bytes{}{}", what,
                                                wanted, found, because.empty() ? "" : "; ", because));
}

Result<VoxelBytes> readPlain(std::ifstream& stream, const VoxelSource& source, std::uint64_t fileSize,
                             std::uint64_t wanted, const std::string& what, const Progress& progress) {
    const std::uint64_t start = source.skip + source.skipDecoded;
    const std::uint64_t there = fileSize > start ? fileSize - start : 0;
    const std::uint64_t available = source.countsFromEnd ? fileSize : there;
    if (available < wanted) return tooShort(what, wanted, available, {});
    const std::uint64_t from = source.countsFromEnd ? fileSize - wanted : start;
    stream.seekg(static_cast<std::streamoff>(from));
    VoxelBytes result;
    result.bytes.resize(wanted);
    result.surplus = source.countsFromEnd ? 0 : available - wanted;
    for (std::uint64_t done = 0; done < wanted;) {
        if (!goOn(progress, static_cast<double>(done) / static_cast<double>(wanted), "reading voxels")) {
            return fail(ErrorCode::Cancelled, "reading was cancelled");
        }
        const std::uint64_t piece = std::min<std::uint64_t>(16 * kPiece, wanted - done);
        stream.read(reinterpret_cast<char*>(result.bytes.data() + done), static_cast<std::streamsize>(piece));
        done += static_cast<std::uint64_t>(stream.gcount());
        if (!stream) return tooShort(what, wanted, done, "the file could not be read further");
    }
    return result;
}

Result<VoxelBytes> readDeflated(std::ifstream& stream, const VoxelSource& source, std::uint64_t fileSize,
                                std::uint64_t wanted, const std::string& what, const Progress& progress) {
    const std::uint64_t packed = fileSize > source.skip ? fileSize - source.skip : 0;
    std::uint64_t most = 0;
    if (__builtin_mul_overflow(packed, kDeflateMax, &most)) most = UINT64_MAX;
    if (wanted > most || source.skipDecoded > most) {
        return fail(
            ErrorCode::Corrupt,
            fmt::format("expected {} = {} bytes of voxels; {} compressed bytes cannot hold more than {}",
                        what, wanted, packed, most));
    }
    stream.seekg(static_cast<std::streamoff>(source.skip));
    Inflater inflater(stream);
    std::vector<std::byte> scratch(kPiece);
    for (std::uint64_t done = 0; done < source.skipDecoded;) {
        const std::size_t got =
            inflater.read(scratch.data(), std::min<std::uint64_t>(kPiece, source.skipDecoded - done));
        if (got == 0) return tooShort(what, wanted, 0, inflater.problem());
        done += got;
    }
    VoxelBytes result;
    result.bytes.resize(wanted);
    for (std::uint64_t done = 0; done < wanted;) {
        if (!goOn(progress, static_cast<double>(done) / static_cast<double>(wanted),
                  "decompressing voxels")) {
            return fail(ErrorCode::Cancelled, "reading was cancelled");
        }
        const std::size_t got =
            inflater.read(result.bytes.data() + done, std::min<std::uint64_t>(4 * kPiece, wanted - done));
        if (got == 0) return tooShort(what, wanted, done, inflater.problem());
        done += got;
    }
    // To the end, so that the checksum is verified and what follows is counted.
    while (const std::size_t got = inflater.read(scratch.data(), kPiece)) {
        result.surplus += got;
        if (!goOn(progress, 1.0, "checking the compressed data"))
            return fail(ErrorCode::Cancelled, "reading was cancelled");
    }
    if (!inflater.problem().empty()) {
        return fail(ErrorCode::Corrupt, fmt::format("{} after {} of the expected {} bytes of voxels",
                                                    inflater.problem(), wanted, wanted));
    }
    return result;
}

}  // namespace

bool isGzip(std::string_view start) {
    return start.size() >= 2 && start[0] == '\x1f' && start[1] == '\x8b';
}

Result<std::uint64_t> regularFileSize(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status))
        return fail(ErrorCode::NotFound, fmt::format("{} does not exist", shownPath(file)));
    if (!fs::is_regular_file(status))
        return fail(ErrorCode::Unreadable, fmt::format("{} is not a regular file", shownPath(file)));
    const std::uintmax_t size = fs::file_size(file, error);
    if (error) return fail(ErrorCode::Unreadable, fmt::format("{}: {}", shownPath(file), error.message()));
    return size;
}

std::string firstBytes(const fs::path& file, std::size_t count, bool gunzip) {
    std::string result(count, '\0');
    if (!regularFileSize(file)) return {};
    std::ifstream stream(file, std::ios::binary);
    stream.read(result.data(), static_cast<std::streamsize>(count));
    result.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    if (!gunzip || !isGzip(result)) return result;
    stream.clear();
    stream.seekg(0);
    Inflater inflater(stream);
    result.assign(count, '\0');
    result.resize(inflater.read(reinterpret_cast<std::byte*>(result.data()), count));
    return result;
}

Result<VoxelBytes> readVoxels(const VoxelSource& source, std::uint64_t wanted, const std::string& what,
                              const Progress& progress) {
    const auto size = regularFileSize(source.file);
    if (!size) return tl::unexpected(size.error());
    std::ifstream stream(source.file, std::ios::binary);
    if (!stream)
        return fail(ErrorCode::Unreadable, fmt::format("{} could not be opened", shownPath(source.file)));
    return source.deflated ? readDeflated(stream, source, *size, wanted, what, progress)
                           : readPlain(stream, source, *size, wanted, what, progress);
}

}  // namespace pellucid::io
