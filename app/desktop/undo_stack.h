// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace pellucid::app {

/// Named scene changes, each with the scene before and after it. Steps of one gesture (a drag, a wheel turn)
/// become one entry: the undo of a drag is the scene before the drag.
class UndoStack {
public:
    struct Entry {
        std::string name;     ///< "Rotate", "Window and level": shown in the menu.
        std::string gesture;  ///< Entries with the same non-empty gesture merge until closeGesture().
        Scene before;
        Scene after;
    };

    /// Drops what could be redone. Does nothing when before == after.
    void push(std::string name, const Scene& before, const Scene& after, const std::string& gesture);
    /// The next push begins a new entry; an entry that came back to where it began disappears.
    void closeGesture();
    void clear();

    [[nodiscard]] bool canUndo() const { return m_done > 0; }
    [[nodiscard]] bool canRedo() const { return m_done < m_entries.size(); }
    /// Of the change that undo() takes back; empty when there is none.
    [[nodiscard]] std::string undoName() const;
    [[nodiscard]] std::string redoName() const;
    /// The scene to show now. Precondition: canUndo() / canRedo().
    [[nodiscard]] Scene undo();
    [[nodiscard]] Scene redo();

private:
    std::vector<Entry> m_entries;
    std::size_t m_done = 0;  ///< Entries before this one are applied.
};

}  // namespace pellucid::app
