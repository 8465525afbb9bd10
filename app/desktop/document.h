// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "app/desktop/opened_scan.h"
#include "app/desktop/undo_stack.h"
#include "app/desktop/view_scenes.h"

namespace pellucid::app {

/// What the main window shows: a scene, its volumes, and the crosshair that the slice views share. The only
/// place that changes the scene; every change has a name and can be undone. GUI thread.
class Document : public QObject {
    Q_OBJECT

public:
    using QObject::QObject;

    [[nodiscard]] bool isEmpty() const { return m_scan.volumes.empty(); }
    [[nodiscard]] const Scene& scene() const { return m_scan.scene; }
    [[nodiscard]] const std::vector<VolumePtr>& volumes() const { return m_scan.volumes; }
    /// Everything unset filled in from the data. Precondition of this and the next four: not isEmpty().
    [[nodiscard]] Scene completeScene() const { return completed(m_scan.scene, m_scan.volumes); }
    [[nodiscard]] const Volume& volume() const { return *m_scan.volumes.front(); }
    [[nodiscard]] const VolumeItem& item() const { return m_scan.scene.volumes.front(); }
    [[nodiscard]] const Histogram& histogram() const { return m_scan.histogram; }
    [[nodiscard]] const TransferFunction1D& dataFunction() const { return m_scan.dataFunction; }
    /// For the title: the scene file's name, else the volume's.
    [[nodiscard]] QString title() const;
    [[nodiscard]] const std::filesystem::path& sceneFile() const { return m_sceneFile; }
    [[nodiscard]] bool isModified() const;

    /// Shows another scan; the crosshair goes to the middle, nothing can be undone.
    void replace(OpenedScan scan);
    /// The scene is in this file from now on.
    void setSaved(const std::filesystem::path& sceneFile);

    /// Changes the scene as one named step. With a `gesture`, changes merge until endGesture() or another
    /// gesture. A scene that does not validate is refused with the signal refused(), and nothing changes.
    void edit(const std::string& name, const Scene& next, const std::string& gesture = {});
    template <class F>
    void change(const std::string& name, const std::string& gesture, F&& f) {
        if (isEmpty()) return;
        Scene next = m_scan.scene;
        f(next);
        edit(name, next, gesture);
    }
    /// As change(), for the first volume's item.
    template <class F>
    void changeItem(const std::string& name, const std::string& gesture, F&& f) {
        change(name, gesture, [&](Scene& next) { f(next.volumes.front()); });
    }
    void endGesture();

    [[nodiscard]] const UndoStack& undoStack() const { return m_undo; }
    void undo();
    void redo();

    [[nodiscard]] glm::dvec3 crosshairMm() const { return m_crosshairMm; }
    void setCrosshairMm(glm::dvec3 wishMm);
    void stepSlice(Plane plane, int steps);
    /// To the slice with this number, see sliceNumber; the other two views keep their slices.
    void setSliceNumber(Plane plane, int number);

Q_SIGNALS:
    void replaced();  ///< Other volumes; sceneChanged and crosshairChanged follow.
    void sceneChanged();
    void crosshairChanged();
    void undoChanged();
    void refused(const QString& sentence);

private:
    void show(const Scene& next);

    OpenedScan m_scan;
    UndoStack m_undo;
    Scene m_savedScene;
    std::filesystem::path m_sceneFile;
    glm::dvec3 m_crosshairMm{0.0};
};

}  // namespace pellucid::app
