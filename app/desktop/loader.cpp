// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/loader.h"

#include <chrono>
#include <utility>

namespace pellucid::app {

namespace {
// A progress report more often than this would only keep the event loop busy.
constexpr std::chrono::milliseconds kReportEvery{40};
}  // namespace

Loader::~Loader() {
    for (const auto& job : m_jobs) job->cancelled = true;
}

void Loader::start(const std::vector<std::filesystem::path>& paths, const io::LoadOptions& options) {
    std::erase_if(m_jobs, [](const auto& job) { return job->ended.load(); });
    for (const auto& job : m_jobs) job->cancelled = true;
    Job& job = *m_jobs.emplace_back(std::make_unique<Job>());
    job.number = m_current = ++m_lastNumber;
    job.paths = paths;
    job.thread = std::jthread([this, &job, options] { run(job, options); });
}

void Loader::cancel() {
    if (!isLoading()) return;
    m_current = 0;
    m_jobs.back()->cancelled = true;
    Q_EMIT failed(Error{ErrorCode::Cancelled, "Opening was cancelled.", {}}, m_jobs.back()->paths);
}

void Loader::run(Job& job, io::LoadOptions options) {
    auto lastReport = std::chrono::steady_clock::time_point{};
    options.progress = [this, &job, lastReport](double fraction, std::string_view what) mutable {
        const auto now = std::chrono::steady_clock::now();
        if (now - lastReport >= kReportEvery) {
            lastReport = now;
            const auto report = [this, number = job.number, fraction,
                                 text = QString::fromStdString(std::string(what))] {
                if (number == m_current) Q_EMIT progressed(fraction, text);
            };
            QMetaObject::invokeMethod(this, report, Qt::QueuedConnection);
        }
        return !job.cancelled.load();
    };
    options.coarse = [this, number = job.number](VolumePtr coarse) {
        QMetaObject::invokeMethod(
            this,
            [this, number, coarse = std::move(coarse)] {
                if (number == m_current) Q_EMIT previewed(coarse);
            },
            Qt::QueuedConnection);
    };
    // Shared, because Qt copies what it queues.
    auto outcome =
        std::make_shared<Outcome>(Outcome{job.number, job.paths, openScan(job.paths, options), {}});
    if (!outcome->scan && outcome->scan.error().code == ErrorCode::Inconsistent && options.seriesUid.empty())
        if (auto found = io::scanDicom(job.paths, options.progress); found && found->series.size() > 1)
            outcome->series = std::move(found->series);
    QMetaObject::invokeMethod(
        this, [this, outcome] { finish(std::move(*outcome)); }, Qt::QueuedConnection);
    job.ended = true;
}

void Loader::finish(Outcome outcome) {
    if (outcome.number != m_current) return;
    m_current = 0;
    if (outcome.scan)
        Q_EMIT loaded(std::move(*outcome.scan));
    else if (!outcome.series.empty())
        Q_EMIT seriesFound(outcome.series, outcome.paths);
    else
        Q_EMIT failed(outcome.scan.error(), outcome.paths);
}

}  // namespace pellucid::app
