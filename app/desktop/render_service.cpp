// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/render_service.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "renderer/resize.h"
#include "scene/image.h"

namespace pellucid::app {

namespace {

QImage pictureOf(const ImageF& image, const RenderService::Request& request) {
    const bool transparent = request.scene.picture.transparent;
    const glm::ivec2 size = request.shownSize.value_or(image.size);
    const Image8 bytes = quantise(size == image.size ? image : renderer::resized(image, size), transparent,
                                  request.scene.quality.dither);
    const auto format = bytes.channels == 4 ? QImage::Format_RGBA8888 : QImage::Format_RGB888;
    const QImage shared(bytes.bytes.data(), bytes.size.x, bytes.size.y, bytes.size.x * bytes.channels,
                        format);
    return shared.copy();
}

}  // namespace

RenderService::RenderService(QObject* parent)
    : QObject(parent), m_thread([this](const std::stop_token& stop) { work(stop); }) {}

RenderService::~RenderService() {
    m_thread.request_stop();
    m_thread.join();
}

std::uint64_t RenderService::request(Request request) {
    const std::lock_guard lock(m_mutex);
    const std::uint64_t number = ++m_lastNumber;
    if (m_running && m_running->priority == Priority::Full) {
        const bool isNewer = m_running->channel == request.channel;
        if (isNewer || request.priority < Priority::Full) {
            m_running->stop = true;
            m_running->comeBack = !isNewer;
        }
    }
    const int channel = request.channel;
    std::optional<renderer::Refinement> refinement;
    if (request.refines) refinement.emplace(request.scene, request.chosen, request.refinesFrom);
    m_waiting[channel] =
        std::make_unique<Job>(Job{number, std::move(request), std::move(refinement), nullptr, {}});
    m_wake.notify_one();
    return number;
}

void RenderService::cancel(int channel) {
    const std::lock_guard lock(m_mutex);
    m_waiting.erase(channel);
    if (!m_running || m_running->channel != channel) return;
    m_running->stop = true;
    m_running->comeBack = false;
}

void RenderService::work(const std::stop_token& stop) {
    auto made = renderer::Renderer::headless();
    const auto info = made ? made->deviceInfo() : renderer::Renderer::DeviceInfo{};
    const QString error = made ? QString{} : QString::fromStdString(made.error().text());
    QMetaObject::invokeMethod(
        this,
        [this, info, error] { Q_EMIT started(QString::fromStdString(info.renderer), error, info.software); },
        Qt::QueuedConnection);

    while (auto job = next(stop)) {
        if (made) {
            draw(*made, std::move(job), stop);
            continue;
        }
        Reply reply = replyTo(*job);
        reply.error = made.error();
        if (release(std::move(job), false, true)) post(std::move(reply));
    }
}

std::unique_ptr<RenderService::Job> RenderService::next(const std::stop_token& stop) {
    std::unique_lock lock(m_mutex);
    m_wake.wait(lock, stop, [this] { return !m_waiting.empty(); });
    if (stop.stop_requested()) return nullptr;
    const auto order = [](const auto& waiting) {
        return std::pair(waiting.second->request.priority, waiting.second->number);
    };
    const auto first = std::min_element(m_waiting.begin(), m_waiting.end(),
                                        [&](const auto& a, const auto& b) { return order(a) < order(b); });
    auto job = std::move(first->second);
    m_waiting.erase(first);
    m_running = Running{job->number, job->request.channel, job->request.priority, false, false};
    return job;
}

RenderService::Reply RenderService::replyTo(const Job& job) {
    Reply reply;
    reply.channel = job.request.channel;
    reply.number = job.number;
    reply.priority = job.request.priority;
    reply.passing = job.request.passing;
    return reply;
}

void RenderService::draw(renderer::Renderer& drawer, std::unique_ptr<Job> job, const std::stop_token& stop) {
    const Request& request = job->request;
    const auto start = std::chrono::steady_clock::now();
    renderer::RenderOptions options;
    options.allowPreview = request.priority == Priority::Interactive;
    options.progress = [this, &stop, priority = request.priority](double fraction, std::string_view) {
        return report(stop, priority, fraction);
    };
    auto frame =
        drawer.render(job->refinement ? job->refinement->next() : request.scene, request.volumes, options);
    const bool wasStopped = !frame && frame.error().code == ErrorCode::Cancelled;
    Reply reply = replyTo(*job);
    if (!frame && !wasStopped && job->refinement && job->refinement->isMeasuring()) {
        job->refinement->giveUp();
        reply.isFinal = job->refinement->isDone();
        reply.frame = job->shown;
        reply.picture = job->picture;
    } else if (frame) {
        const auto before = std::exchange(
            job->shown, job->refinement ? job->refinement->take(std::move(*frame))
                                        : std::make_shared<const renderer::Frame>(std::move(*frame)));
        // The last step of a refinement measures a picture that is there already.
        if (!before || before->image != job->shown->image)
            job->picture = pictureOf(job->shown->image, request);
        reply.frame = job->shown;
        reply.picture = job->picture;
        reply.isFinal = !job->refinement || job->refinement->isDone();
        if (job->refinement) reply.passingErrors = job->refinement->passingErrors();
        reply.totalMs =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    } else {
        reply.error = frame.error();
    }
    if (release(std::move(job), wasStopped, reply.isFinal)) post(std::move(reply));
}

bool RenderService::release(std::unique_ptr<Job> job, bool wasStopped, bool isDone) {
    const std::lock_guard lock(m_mutex);
    const Running running = *std::exchange(m_running, std::nullopt);
    const bool isWanted = !running.stop || running.comeBack;
    // Its channel may have got a newer request meanwhile; that one counts.
    if (isWanted && (wasStopped || !isDone)) m_waiting.try_emplace(running.channel, std::move(job));
    return isWanted && !wasStopped;
}

bool RenderService::report(const std::stop_token& stop, Priority priority, double fraction) {
    if (priority == Priority::Export)
        QMetaObject::invokeMethod(
            this, [this, fraction] { Q_EMIT exportProgressed(fraction); }, Qt::QueuedConnection);
    const std::lock_guard lock(m_mutex);
    return !stop.stop_requested() && !m_running->stop;
}

void RenderService::post(Reply reply) {
    QMetaObject::invokeMethod(
        this, [this, reply = std::move(reply)] { Q_EMIT replied(reply); }, Qt::QueuedConnection);
}

}  // namespace pellucid::app
