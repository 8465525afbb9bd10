// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/document.h"

#include <glm/geometric.hpp>

#include "io/scene_file.h"

namespace pellucid::app {

void Document::replace(OpenedScan scan) {
    m_scan = std::move(scan);
    m_undo.clear();
    m_savedScene = m_scan.scene;
    const bool isScene = m_scan.paths.size() == 1 && io::looksLikeScene(m_scan.paths.front());
    m_sceneFile = isScene ? m_scan.paths.front() : std::filesystem::path{};
    m_crosshairMm = allowedCrosshair(volume().grid(), centreMm(volume().grid()));
    Q_EMIT replaced();
    Q_EMIT sceneChanged();
    Q_EMIT crosshairChanged();
    Q_EMIT undoChanged();
}

void Document::setSaved(const std::filesystem::path& sceneFile) {
    m_sceneFile = sceneFile;
    m_savedScene = m_scan.scene;
    Q_EMIT undoChanged();
}

bool Document::isModified() const {
    return !isEmpty() && !(m_scan.scene == m_savedScene);
}

QString Document::title() const {
    if (isEmpty()) return {};
    if (!m_sceneFile.empty()) return QString::fromStdString(m_sceneFile.filename().string());
    return QString::fromStdString(item().name.empty() ? volume().info().name : item().name);
}

void Document::edit(const std::string& name, const Scene& next, const std::string& gesture) {
    if (isEmpty() || next == m_scan.scene) return;
    if (const auto valid = validate(next); !valid) {
        Q_EMIT refused(QString::fromStdString(valid.error().text()));
        return;
    }
    m_undo.push(name, m_scan.scene, next, gesture);
    show(next);
}

void Document::endGesture() {
    m_undo.closeGesture();
    Q_EMIT undoChanged();
}

void Document::undo() {
    if (m_undo.canUndo()) show(m_undo.undo());
}

void Document::redo() {
    if (m_undo.canRedo()) show(m_undo.redo());
}

void Document::show(const Scene& next) {
    m_scan.scene = next;
    Q_EMIT sceneChanged();
    Q_EMIT undoChanged();
}

void Document::setCrosshairMm(glm::dvec3 wishMm) {
    if (isEmpty()) return;
    const glm::dvec3 next = allowedCrosshair(volume().grid(), wishMm);
    if (next == m_crosshairMm) return;
    m_crosshairMm = next;
    Q_EMIT crosshairChanged();
}

void Document::stepSlice(Plane plane, int steps) {
    if (isEmpty()) return;
    setCrosshairMm(m_crosshairMm +
                   steps * sliceRange(volume().grid(), plane).stepMm * nextSliceDirection(plane));
}

void Document::setSliceNumber(Plane plane, int number) {
    if (isEmpty()) return;
    const SliceRange range = sliceRange(volume().grid(), plane);
    const glm::dvec3 direction = nextSliceDirection(plane);
    const double wanted = range.firstMm + number * range.stepMm;
    setCrosshairMm(m_crosshairMm + (wanted - glm::dot(m_crosshairMm, direction)) * direction);
}

}  // namespace pellucid::app
