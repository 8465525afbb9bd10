// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace pellucid::bench {

/// One thread that does what it is told, one job at a time. The renderer lives on it: its EGL context and
/// VTK's GLX context cannot both be current on one thread.
class RenderThread {
public:
    RenderThread() : m_thread([this] { work(); }) {}
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;
    ~RenderThread() {
        {
            const std::lock_guard lock(m_mutex);
            m_stop = true;
        }
        m_changed.notify_all();
        m_thread.join();
    }

    /// Runs the job on the thread and returns when it is done.
    void run(std::function<void()> job) {
        std::unique_lock lock(m_mutex);
        m_job = std::move(job);
        m_changed.notify_all();
        m_changed.wait(lock, [this] { return !m_job; });
    }

private:
    void work() {
        std::unique_lock lock(m_mutex);
        while (true) {
            m_changed.wait(lock, [this] { return m_stop || m_job; });
            if (!m_job) return;
            m_job();
            m_job = nullptr;
            m_changed.notify_all();
        }
    }

    std::mutex m_mutex;
    std::condition_variable m_changed;
    std::function<void()> m_job;
    bool m_stop = false;
    std::thread m_thread;
};

}  // namespace pellucid::bench
