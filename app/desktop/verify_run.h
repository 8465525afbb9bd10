// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <thread>

#include "accuracy/verification.h"

namespace pellucid::app {

/// A self-test: accuracy::verify, or what stands for it.
using Verify = std::function<Result<accuracy::Verification>(
    renderer::Renderer& renderer, const accuracy::VerificationParts& parts, const Progress& progress,
    const std::function<void(const accuracy::VerificationLine&)>& found)>;

/// Runs a self-test on a thread with a renderer of its own, beside the one that draws the views. GUI thread.
class VerifyRun : public QObject {
    Q_OBJECT

public:
    explicit VerifyRun(Verify verify) : m_verify(std::move(verify)) {}
    /// Cancels, and waits until the renderer has been asked next (at most a few seconds).
    ~VerifyRun() override = default;

    /// Precondition: not isRunning().
    void start(const accuracy::VerificationParts& parts);
    /// The run ends in ended() when it next asks.
    void cancel() { m_thread.request_stop(); }
    [[nodiscard]] bool isRunning() const { return m_isRunning; }

Q_SIGNALS:
    void progressed(double fraction, const QString& what);
    void found(const pellucid::accuracy::VerificationLine& line);
    /// `error` is null when all parts are through (ErrorCode::Cancelled after cancel()).
    void ended(std::shared_ptr<const pellucid::accuracy::Verification> verification,
               std::shared_ptr<const pellucid::Error> error);

private:
    void work(const std::stop_token& stop, const accuracy::VerificationParts& parts);

    Verify m_verify;
    bool m_isRunning = false;
    std::jthread m_thread;
};

}  // namespace pellucid::app
