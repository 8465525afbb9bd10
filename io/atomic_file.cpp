// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "io/text_scan.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;

std::string reason(int number) {
    return std::generic_category().message(number);
}

/// Writes everything to an open descriptor; 0 or errno.
int writeAll(int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ::ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return 0;
}

tl::unexpected<Error> writeFailed(const fs::path& file, int number) {
    return fail(ErrorCode::WriteFailed,
                fmt::format("{} could not be written: {}", shownPath(file), reason(number)));
}

/// Devices and pipes (/dev/null, /dev/stdout) are written in place: renaming would replace the device itself.
Result<void> writeInPlace(const fs::path& file, std::span<const std::byte> bytes) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return writeFailed(file, errno);
    const int error = writeAll(descriptor, bytes);
    ::close(descriptor);
    if (error != 0) return writeFailed(file, error);
    return {};
}

}  // namespace

Result<void> writeFile(const fs::path& file, std::span<const std::byte> bytes) {
    std::error_code ignored;
    const fs::file_status status = fs::status(file, ignored);
    if (fs::is_directory(status)) return writeFailed(file, EISDIR);
    if (fs::exists(status) && !fs::is_regular_file(status)) return writeInPlace(file, bytes);

    // A symbolic link keeps pointing: the file it names is what is replaced.
    fs::path target = fs::exists(status) ? fs::canonical(file, ignored) : file;
    if (target.empty()) target = file;

    static std::atomic<unsigned> counter{0};
    const fs::path temporary = target.parent_path() / fmt::format(".{}.{}-{}.tmp", target.filename().string(),
                                                                  ::getpid(), ++counter);
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) return writeFailed(file, errno);
    int error = writeAll(descriptor, bytes);
    if (error == 0 && ::fsync(descriptor) != 0) error = errno;
    if (::close(descriptor) != 0 && error == 0) error = errno;
    if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
    if (error != 0) {
        ::unlink(temporary.c_str());
        return writeFailed(file, error);
    }
    return {};
}

Result<std::vector<std::byte>> readFile(const fs::path& file, std::uint64_t maxBytes) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status))
        return fail(ErrorCode::NotFound, fmt::format("{} does not exist", shownPath(file)));
    if (fs::is_directory(status))
        return fail(ErrorCode::Unreadable, fmt::format("{} is a folder", shownPath(file)));
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        return fail(ErrorCode::Unreadable,
                    fmt::format("{} could not be opened: {}", shownPath(file), reason(errno)));

    // Read in pieces and not by the stated size: pipes have none, and a file may grow while it is read.
    std::vector<std::byte> bytes;
    constexpr std::size_t kPiece = 1 << 20;
    if (fs::is_regular_file(status)) {
        const std::uintmax_t size = fs::file_size(file, error);
        if (!error && size > maxBytes) {
            return fail(ErrorCode::TooLarge,
                        fmt::format("{} has {} bytes; at most {} are read", shownPath(file), size, maxBytes));
        }
        if (!error) bytes.reserve(static_cast<std::size_t>(size));
    }
    while (stream) {
        const std::size_t before = bytes.size();
        bytes.resize(before + kPiece);
        stream.read(reinterpret_cast<char*>(bytes.data() + before), kPiece);
        bytes.resize(before + static_cast<std::size_t>(stream.gcount()));
        if (bytes.size() > maxBytes) {
            return fail(ErrorCode::TooLarge,
                        fmt::format("{} has more than the {} bytes that are read at most", shownPath(file),
                                    maxBytes));
        }
    }
    if (stream.bad())
        return fail(ErrorCode::Unreadable,
                    fmt::format("{} could not be read: {}", shownPath(file), reason(errno)));
    return bytes;
}

}  // namespace pellucid::io
