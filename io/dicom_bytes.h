// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <span>

#include "scene/result.h"

namespace pellucid::io {

/// Bytes read from front to back, in memory of constant size.
class ByteSource {
public:
    static constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();

    ByteSource() = default;
    ByteSource(const ByteSource&) = delete;
    ByteSource& operator=(const ByteSource&) = delete;
    virtual ~ByteSource() = default;

    /// Fills `out`; fewer bytes only at the end. Returns how many were read.
    virtual std::size_t read(std::span<std::uint8_t> out) = 0;
    /// Returns how many bytes were skipped; fewer than asked only at the end.
    virtual std::uint64_t skip(std::uint64_t count) = 0;
    /// Where the end is, kUnknown while it is not.
    [[nodiscard]] virtual std::uint64_t size() const = 0;
    /// Bytes read and skipped so far.
    [[nodiscard]] std::uint64_t position() const { return m_position; }

protected:
    std::uint64_t m_position = 0;
};

class FileSource final : public ByteSource {
public:
    /// Errors: NotFound, Unreadable.
    static Result<std::unique_ptr<FileSource>> open(const std::filesystem::path& file);

    std::size_t read(std::span<std::uint8_t> out) override;
    std::uint64_t skip(std::uint64_t count) override;
    [[nodiscard]] std::uint64_t size() const override { return m_size; }
    void seek(std::uint64_t position);

private:
    std::ifstream m_stream;
    std::uint64_t m_size = 0;
};

/// The bytes that a raw deflate stream (RFC 1951, as DICOM's deflated transfer syntax has it) holds.
class InflateSource final : public ByteSource {
public:
    /// Takes what is left of `packed`; that outlives this.
    explicit InflateSource(ByteSource& packed);
    ~InflateSource() override;

    std::size_t read(std::span<std::uint8_t> out) override;
    std::uint64_t skip(std::uint64_t count) override;
    [[nodiscard]] std::uint64_t size() const override { return kUnknown; }
    /// True when a read met an error in the stream, or its input ended before it.
    [[nodiscard]] bool isDamaged() const;

private:
    struct State;
    std::unique_ptr<State> m_state;
};

}  // namespace pellucid::io
