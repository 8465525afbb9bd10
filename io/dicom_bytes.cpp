// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/dicom_bytes.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>

#include "io/text_scan.h"

namespace pellucid::io {

Result<std::unique_ptr<FileSource>> FileSource::open(const std::filesystem::path& file) {
    std::error_code error;
    const std::string name = shown(file.filename().string());
    if (!std::filesystem::exists(file, error)) {
        return fail(ErrorCode::NotFound, fmt::format("{} does not exist", name));
    }
    // Only what is a plain file: opening a pipe or a device would wait or never end.
    if (!std::filesystem::is_regular_file(file, error)) {
        return fail(ErrorCode::Unreadable, fmt::format("{} is not a plain file", name));
    }
    auto source = std::make_unique<FileSource>();
    source->m_size = std::filesystem::file_size(file, error);
    source->m_stream.open(file, std::ios::binary);
    if (error || !source->m_stream) {
        return fail(ErrorCode::Unreadable, fmt::format("{} cannot be opened for reading", name));
    }
    return source;
}

std::size_t FileSource::read(std::span<std::uint8_t> out) {
    m_stream.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
    const auto count = static_cast<std::size_t>(m_stream.gcount());
    m_position += count;
    return count;
}

std::uint64_t FileSource::skip(std::uint64_t count) {
    const std::uint64_t step = std::min(count, m_size - std::min(m_size, m_position));
    seek(m_position + step);
    return step;
}

void FileSource::seek(std::uint64_t position) {
    m_stream.clear();
    m_stream.seekg(static_cast<std::streamoff>(position));
    m_position = position;
}

struct InflateSource::State {
    ByteSource& packed;
    z_stream zlib{};
    std::array<std::uint8_t, 16384> input{};
    bool ended = false;
    bool damaged = false;
};

InflateSource::InflateSource(ByteSource& packed)
    : m_state(std::make_unique<State>(State{packed, {}, {}, false, false})) {
    // Negative window bits: no zlib header and no checksum.
    m_state->ended = inflateInit2(&m_state->zlib, -MAX_WBITS) != Z_OK;
}

InflateSource::~InflateSource() {
    inflateEnd(&m_state->zlib);
}

std::size_t InflateSource::read(std::span<std::uint8_t> out) {
    z_stream& zlib = m_state->zlib;
    zlib.next_out = out.data();
    zlib.avail_out = static_cast<uInt>(out.size());
    while (zlib.avail_out > 0 && !m_state->ended) {
        if (zlib.avail_in == 0) {
            zlib.next_in = m_state->input.data();
            zlib.avail_in = static_cast<uInt>(m_state->packed.read(m_state->input));
        }
        const bool starved = zlib.avail_in == 0;
        const int status = starved ? Z_BUF_ERROR : inflate(&zlib, Z_NO_FLUSH);
        m_state->ended = status != Z_OK;
        m_state->damaged = m_state->ended && status != Z_STREAM_END;
    }
    const std::size_t count = out.size() - zlib.avail_out;
    m_position += count;
    return count;
}

bool InflateSource::isDamaged() const {
    return m_state->damaged;
}

std::uint64_t InflateSource::skip(std::uint64_t count) {
    std::array<std::uint8_t, 16384> ignored{};
    std::uint64_t done = 0;
    while (done < count) {
        const std::size_t wanted =
            static_cast<std::size_t>(std::min<std::uint64_t>(ignored.size(), count - done));
        const std::size_t got = read(std::span(ignored).first(wanted));
        done += got;
        if (got < wanted) break;
    }
    return done;
}

}  // namespace pellucid::io
