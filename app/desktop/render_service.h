// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QImage>
#include <QObject>
#include <QString>
#include <condition_variable>
#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "renderer/interaction.h"
#include "renderer/refinement.h"
#include "renderer/renderer.h"
#include "scene/scene.h"

namespace pellucid::app {

/// The one thread that draws. It owns a headless renderer, so the GUI thread never touches OpenGL and never
/// waits. Each channel (a view, the export) has at most one waiting request: a newer one takes its place.
class RenderService : public QObject {
    Q_OBJECT

public:
    /// In the order of service. Slices and small pictures under the mouse are short and are not interrupted;
    /// a full picture gives way to them and is then drawn again; an export runs until it is done or
    /// cancelled.
    enum class Priority { Slice, Interactive, Full, Export };

    struct Request {
        int channel = 0;
        Scene scene;
        std::vector<VolumePtr> volumes{};
        Priority priority = Priority::Full;
        /// Draws it in pictures of ever smaller steps and states the error (renderer::Refinement). Each
        /// picture is answered, and slices and interactive pictures are drawn in between.
        bool refines = false;
        std::optional<Quality> chosen{};  ///< For Refinement.
        double refinesFrom = 4.0;         ///< For Refinement.
        /// For a picture in passing: what it leaves out (comes back with the reply), and the size that its
        /// picture is enlarged to.
        std::optional<renderer::Passing> passing{};
        std::optional<glm::ivec2> shownSize{};
    };

    /// What became of a request: a frame with its picture, or an error. A request that a newer one replaced
    /// has no further reply.
    struct Reply {
        int channel = 0;
        std::uint64_t number = 0;  ///< As request() gave it.
        Priority priority = Priority::Full;
        std::shared_ptr<const renderer::Frame> frame;
        /// The frame, enlarged where asked, through quantise(): RGB888, or RGBA8888 when the scene is
        /// transparent.
        QImage picture;
        std::optional<Error> error;
        bool isFinal = true;   ///< False while further replies to a request that refines are to come.
        double totalMs = 0.0;  ///< From the start of the last drawing until the picture was there.
        std::optional<renderer::Passing> passing;              ///< Of the request.
        std::optional<renderer::PassingErrors> passingErrors;  ///< From a refinement.
    };

    explicit RenderService(QObject* parent = nullptr);
    /// Cancels what runs and waits for it.
    ~RenderService() override;

    /// Returns the request's number, never 0.
    std::uint64_t request(Request request);
    /// Forgets the channel's waiting request and stops its running one; neither is answered.
    void cancel(int channel);

Q_SIGNALS:
    /// Once, after the start: the device, or why there is none (each request is then answered with that
    /// error).
    void started(const QString& device, const QString& error, bool isSoftwareDevice);
    void replied(const pellucid::app::RenderService::Reply& reply);
    /// Of a running export.
    void exportProgressed(double fraction);

private:
    struct Job {
        std::uint64_t number = 0;
        Request request;
        std::optional<renderer::Refinement> refinement;
        std::shared_ptr<const renderer::Frame> shown;  ///< What the refinement has come to.
        QImage picture;                                ///< Of the same.
    };
    struct Running {
        std::uint64_t number = 0;
        int channel = 0;
        Priority priority = Priority::Full;
        bool stop = false;      ///< Asked by the renderer between tiles.
        bool comeBack = false;  ///< Interrupted by something shorter: to be drawn again.
    };

    static Reply replyTo(const Job& job);
    void work(const std::stop_token& stop);
    /// Waits for work; null when it is time to end.
    std::unique_ptr<Job> next(const std::stop_token& stop);
    void draw(renderer::Renderer& drawer, std::unique_ptr<Job> job, const std::stop_token& stop);
    /// Ends the running job, which waits again when it was interrupted by something shorter or is not done.
    /// True when its result is still wanted.
    bool release(std::unique_ptr<Job> job, bool wasStopped, bool isDone);
    bool report(const std::stop_token& stop, Priority priority, double fraction);
    void post(Reply reply);

    std::mutex m_mutex;
    std::condition_variable_any m_wake;
    std::map<int, std::unique_ptr<Job>> m_waiting;  ///< By channel.
    std::optional<Running> m_running;
    std::uint64_t m_lastNumber = 0;
    std::jthread m_thread;  ///< Last: it uses the rest.
};

}  // namespace pellucid::app
