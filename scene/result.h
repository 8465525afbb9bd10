// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace pellucid {

/// What kind of failure an Error is; tests and exit statuses depend on it, people read Error::text().
enum class ErrorCode {
    InvalidArgument,  ///< A value asked for is outside what is allowed.
    NotFound,         ///< A file or a name does not exist.
    Unreadable,       ///< It exists and cannot be opened or decoded.
    Corrupt,          ///< It contradicts itself: truncated, wrong size, impossible numbers.
    Unsupported,      ///< Valid, and not something this program draws.
    Inconsistent,     ///< Parts do not fit together: a missing slice, two series.
    TooLarge,         ///< Beyond a stated limit.
    Gpu,              ///< The OpenGL driver refused.
    WriteFailed,      ///< Output could not be written.
    Cancelled         ///< The user stopped it.
};

/// An expected failure: a sentence a person can act on, and where it happened, innermost first.
struct Error {
    ErrorCode code = ErrorCode::InvalidArgument;
    std::string message;
    std::vector<std::string> context;

    /// "outer: inner: message".
    [[nodiscard]] std::string text() const;
    bool operator==(const Error&) const = default;
};

template <class T>
using Result = tl::expected<T, Error>;

/// Usage: `return fail(ErrorCode::Corrupt, fmt::format(...));` from any function returning Result<T>.
[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string message) {
    return tl::unexpected<Error>(Error{code, std::move(message), {}});
}

/// Passes an error on with one more place named.
[[nodiscard]] inline tl::unexpected<Error> fail(Error error, std::string where) {
    error.context.push_back(std::move(where));
    return tl::unexpected<Error>(std::move(error));
}

/// Something the user must know although the work went on. Data, never printed by a library.
struct Warning {
    std::string message;
    bool operator==(const Warning&) const = default;
};

}  // namespace pellucid
