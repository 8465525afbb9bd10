// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <mutex>

#include "app/cli/cli.h"

namespace pellucid::app {

namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void onInterrupt(int) {
    interrupted.store(true);
}

/// Draws the progress line at most ten times a second, and not before the work has lasted long enough to be
/// noticed.
class ProgressLine {
public:
    void show(double fraction, std::string_view what) {
        const std::lock_guard lock(m_mutex);
        const auto now = Clock::now();
        if (now < m_next) return;
        m_next = now + std::chrono::milliseconds(100);
        m_shown = true;
        fmt::print(stderr, "\r\033[K{:3.0f} % {}", 100.0 * fraction, what);
        std::fflush(stderr);
    }

    void clear() {
        const std::lock_guard lock(m_mutex);
        if (m_shown) fmt::print(stderr, "\r\033[K");
        m_shown = false;
    }

private:
    using Clock = std::chrono::steady_clock;
    std::mutex m_mutex;
    Clock::time_point m_next = Clock::now() + std::chrono::milliseconds(300);
    bool m_shown = false;
};

ProgressLine& progressLine() {
    static ProgressLine line;
    return line;
}

int exitStatus(ErrorCode code) {
    switch (code) {
        case ErrorCode::Gpu:
            return kExitInternal;
        case ErrorCode::Cancelled:
            return kExitCancelled;
        default:
            return kExitRefused;
    }
}

}  // namespace

int report(const Error& error) {
    clearProgress();
    fmt::print(stderr, "pellucid: {}\n", error.text());
    return exitStatus(error.code);
}

int reportUsage(std::string_view sentence, std::string_view command) {
    clearProgress();
    const std::string_view gap = command.empty() ? "" : " ";
    fmt::print(stderr, "pellucid: {}\nTry: pellucid{}{} --help\n", sentence, gap, command);
    return kExitRefused;
}

void printWarnings(const Volume& volume) {
    clearProgress();
    for (const Warning& warning : volume.info().warnings) {
        fmt::print(stderr, "pellucid: warning: {}\n", warning.message);
    }
}

void catchInterrupt() {
    struct sigaction action {};
    action.sa_handler = onInterrupt;
    action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
}

Progress consoleProgress() {
    const bool terminal = isatty(STDERR_FILENO) == 1;
    return [terminal](double fraction, std::string_view what) {
        if (interrupted.load()) return false;
        if (terminal) progressLine().show(fraction, what);
        return true;
    };
}

void clearProgress() {
    progressLine().clear();
}

}  // namespace pellucid::app
