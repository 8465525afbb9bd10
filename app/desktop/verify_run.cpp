// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/verify_run.h"

#include <chrono>

#include "scene/check.h"

namespace pellucid::app {

namespace {

// A progress report more often than this would only keep the event loop busy.
constexpr std::chrono::milliseconds kReportEvery{40};

Result<accuracy::Verification> verifyOnOwnRenderer(
    const Verify& verify, const accuracy::VerificationParts& parts, const Progress& progress,
    const std::function<void(const accuracy::VerificationLine&)>& found) {
    auto renderer = renderer::Renderer::headless();
    if (!renderer) return tl::unexpected(renderer.error());
    return verify(*renderer, parts, progress, found);
}

}  // namespace

void VerifyRun::start(const accuracy::VerificationParts& parts) {
    PELLUCID_CHECK(!m_isRunning);
    m_isRunning = true;
    m_thread = std::jthread([this, parts](const std::stop_token& stop) { work(stop, parts); });
}

void VerifyRun::work(const std::stop_token& stop, const accuracy::VerificationParts& parts) {
    const auto post = [this](auto&& task) {
        QMetaObject::invokeMethod(this, std::forward<decltype(task)>(task), Qt::QueuedConnection);
    };
    auto lastReport = std::chrono::steady_clock::time_point{};
    const auto progress = [&](double fraction, std::string_view what) {
        const auto now = std::chrono::steady_clock::now();
        if (now - lastReport >= kReportEvery) {
            lastReport = now;
            post(
                [this, fraction, text = QString::fromUtf8(what.data(), static_cast<qsizetype>(what.size()))] {
                    Q_EMIT progressed(fraction, text);
                });
        }
        return !stop.stop_requested();
    };
    auto result = verifyOnOwnRenderer(m_verify, parts, progress, [&](const accuracy::VerificationLine& line) {
        post([this, line] { Q_EMIT found(line); });
    });
    std::shared_ptr<const accuracy::Verification> verification;
    std::shared_ptr<const Error> error;
    if (result)
        verification = std::make_shared<const accuracy::Verification>(std::move(*result));
    else
        error = std::make_shared<const Error>(result.error());
    post([this, verification, error] {
        m_isRunning = false;
        Q_EMIT ended(verification, error);
    });
}

}  // namespace pellucid::app
