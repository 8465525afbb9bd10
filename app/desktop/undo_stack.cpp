// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/undo_stack.h"

#include "scene/check.h"

namespace pellucid::app {

namespace {
// A scene is a few kilobytes; the oldest changes go first.
constexpr std::size_t kMaxEntries = 500;
}  // namespace

void UndoStack::push(std::string name, const Scene& before, const Scene& after, const std::string& gesture) {
    if (before == after) return;
    m_entries.resize(m_done);
    if (!gesture.empty() && !m_entries.empty() && m_entries.back().gesture == gesture) {
        m_entries.back().after = after;
        return;
    }
    closeGesture();
    m_entries.push_back({std::move(name), gesture, before, after});
    if (m_entries.size() > kMaxEntries) m_entries.erase(m_entries.begin());
    m_done = m_entries.size();
}

void UndoStack::closeGesture() {
    if (m_done == 0 || m_done != m_entries.size()) return;
    Entry& last = m_entries.back();
    if (!last.gesture.empty() && last.before == last.after) {
        m_entries.pop_back();
        m_done = m_entries.size();
        return;
    }
    last.gesture.clear();
}

void UndoStack::clear() {
    m_entries.clear();
    m_done = 0;
}

std::string UndoStack::undoName() const {
    return canUndo() ? m_entries[m_done - 1].name : std::string{};
}
std::string UndoStack::redoName() const {
    return canRedo() ? m_entries[m_done].name : std::string{};
}

Scene UndoStack::undo() {
    PELLUCID_CHECK(canUndo());
    m_entries[m_done - 1].gesture.clear();
    return m_entries[--m_done].before;
}

Scene UndoStack::redo() {
    PELLUCID_CHECK(canRedo());
    return m_entries[m_done++].after;
}

}  // namespace pellucid::app
