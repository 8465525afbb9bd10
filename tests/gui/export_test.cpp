// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTemporaryDir>

#include "app/desktop/export_dialog.h"
#include "io/image_file.h"
#include "scene/image.h"
#include "tests/gui/gui_support.h"

namespace pellucid::test {
namespace {

class ExportTest : public GuiTest {
protected:
    void openDialog(const QString& view, const std::string& name, glm::ivec2 size, bool transparent) {
        file = std::filesystem::path(folder.path().toStdString()) / name;
        child<QAction>("export")->trigger();
        auto* combo = child<QComboBox>("exportView");
        combo->setCurrentIndex(combo->findText(view));
        child<QSpinBox>("exportWidth")->setValue(size.x);
        child<QSpinBox>("exportHeight")->setValue(size.y);
        child<QCheckBox>("exportTransparent")->setChecked(transparent);
        child<QLineEdit>("exportFile")->setText(QString::fromStdString(file.string()));
    }
    void save() { child<QDialogButtonBox>("exportButtons")->button(QDialogButtonBox::Save)->click(); }
    [[nodiscard]] bool waitExported() {
        return waitFor(
            [this] { return window.findChild<QDialog*>(QStringLiteral("exportDialog")) == nullptr; });
    }
    /// What the renderer gives for the same scene, in a context of its own.
    ImageF drawn(Scene scene, glm::ivec2 size, bool transparent) {
        scene.picture.size = size;
        scene.picture.transparent = transparent;
        auto renderer = renderer::Renderer::headless().value();
        return renderer.render(scene, document().volumes()).value().image;
    }

    QTemporaryDir folder;
    std::filesystem::path file;
};

TEST_F(ExportTest, ThePngOfThe3dViewIsTheRenderersPictureByteForByte) {
    openDialog(QStringLiteral("3D"), "volume.png", {333, 222}, false);
    save();
    ASSERT_TRUE(waitExported());
    EXPECT_EQ(io::readPng(file).value(),
              quantise(drawn(volumeView()->shownScene(), {333, 222}, false), false, false));
    EXPECT_TRUE(child<QLabel>("messageText")->text().contains(QStringLiteral("volume.png")));
}

TEST_F(ExportTest, ATransparentPngKeepsTheOpacity) {
    openDialog(QStringLiteral("3D"), "clear.png", {200, 150}, true);
    save();
    ASSERT_TRUE(waitExported());
    const Image8 picture = io::readPng(file).value();
    EXPECT_EQ(picture.channels, 4);
    EXPECT_EQ(picture, quantise(drawn(volumeView()->shownScene(), {200, 150}, true), true, false));
    EXPECT_EQ(picture.bytes[3], 0) << "the corner is empty";
}

TEST_F(ExportTest, AFloatSliceIsTheRenderersPictureBeforeRounding) {
    openDialog(QStringLiteral("Coronal"), "slice.npy", {257, 129}, false);
    save();
    ASSERT_TRUE(waitExported());
    EXPECT_EQ(io::readNpy(file).value(), drawn(coronal()->shownScene(), {257, 129}, false));
}

TEST_F(ExportTest, AFailureIsSaidAndTheDialogStays) {
    openDialog(QStringLiteral("Axial"), "picture.gif", {20, 20}, false);
    save();
    ASSERT_TRUE(waitFor([this] { return child<QLabel>("exportMessage")->isVisible(); }));
    EXPECT_TRUE(child<QLabel>("exportMessage")->text().contains(QStringLiteral(".gif")));
    EXPECT_FALSE(std::filesystem::exists(file));
    file = std::filesystem::path(folder.path().toStdString()) / "picture.pfm";
    child<QLineEdit>("exportFile")->setText(QString::fromStdString(file.string()));
    save();
    ASSERT_TRUE(waitExported());
    EXPECT_EQ(io::readPfm(file).value().size, glm::ivec2(20));
}

TEST_F(ExportTest, CancelWhileDrawingWritesNothing) {
    openDialog(QStringLiteral("3D"), "huge.png", {9000, 9000}, false);
    save();
    auto* cancel = child<QDialogButtonBox>("exportButtons")->button(QDialogButtonBox::Cancel);
    cancel->click();  // Stops the drawing,
    ASSERT_TRUE(child<QDialogButtonBox>("exportButtons")->button(QDialogButtonBox::Save)->isEnabled());
    cancel->click();  // and closes.
    ASSERT_TRUE(waitExported());
    EXPECT_FALSE(std::filesystem::exists(file));
    document().setCrosshairMm(document().crosshairMm() + glm::dvec3(0, 0, 4));
    EXPECT_TRUE(settle()) << "the service goes on after the cancelled picture";
}

}  // namespace
}  // namespace pellucid::test
