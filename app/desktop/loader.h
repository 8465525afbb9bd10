// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QString>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

#include "app/desktop/opened_scan.h"
#include "io/dicom_series.h"

namespace pellucid::app {

/// Opens scans on a thread of its own. One at a time counts: a new one cancels the one before. GUI thread.
class Loader : public QObject {
    Q_OBJECT

public:
    using QObject::QObject;
    /// Cancels and waits for what still runs.
    ~Loader() override;

    void start(const std::vector<std::filesystem::path>& paths, const io::LoadOptions& options = {});
    /// Ends in failed() with ErrorCode::Cancelled at once; the work stops when it next asks.
    void cancel();
    [[nodiscard]] bool isLoading() const { return m_current != 0; }

Q_SIGNALS:
    void progressed(double fraction, const QString& what);
    /// While loading, of large series: a coarse copy to look at. What it becomes is loaded() or failed().
    void previewed(pellucid::VolumePtr coarse);
    void loaded(pellucid::app::OpenedScan scan);
    void failed(pellucid::Error error, std::vector<std::filesystem::path> paths);
    /// Instead of failed(): the paths hold several series, and one must be chosen (LoadOptions::seriesUid).
    void seriesFound(std::vector<pellucid::io::DicomSeries> series, std::vector<std::filesystem::path> paths);

private:
    struct Job {
        std::uint64_t number =
            0;  ///< What the thread posts carries it, and is dropped unless it is the current one.
        std::vector<std::filesystem::path> paths;
        std::atomic<bool> cancelled = false;
        std::atomic<bool> ended = false;
        std::jthread thread;
    };
    /// What a job posts at its end.
    struct Outcome {
        std::uint64_t number = 0;
        std::vector<std::filesystem::path> paths;
        Result<OpenedScan> scan;
        std::vector<io::DicomSeries> series;
    };
    void run(Job& job, io::LoadOptions options);
    void finish(Outcome outcome);

    std::vector<std::unique_ptr<Job>> m_jobs;
    std::uint64_t m_lastNumber = 0;
    std::uint64_t m_current = 0;  ///< 0: none.
};

}  // namespace pellucid::app
