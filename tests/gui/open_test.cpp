// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <QDialog>
#include <QDropEvent>
#include <QLabel>
#include <QListWidget>
#include <QMimeData>
#include <QPushButton>
#include <QTemporaryDir>
#include <QUrl>
#include <cmath>
#include <fstream>

#include "app/desktop/coarse_preview.h"
#include "io/scene_file.h"
#include "tests/gui/gui_support.h"
#include "tests/support/synthetic_dicom.h"

namespace pellucid::test {
namespace {

class OpenTest : public GuiTest {
protected:
    [[nodiscard]] std::filesystem::path folder() const { return m_folder.path().toStdString(); }
    [[nodiscard]] bool waitLoaded() {
        return waitFor([this] { return !window.loader().isLoading(); });
    }
    /// Raw voxels with their sidecar, as large as asked for.
    std::filesystem::path writeRaw(const std::string& name, int n, bool whole = true) {
        const std::filesystem::path file = folder() / name;
        std::ofstream(file, std::ios::binary)
            << std::string(static_cast<std::size_t>(n) * n * n - (whole ? 0 : 7), '\x42');
        std::ofstream(file.string() + ".json") << R"({"size": [)" << n << "," << n << "," << n
                                               << R"(], "type": "uint8", "spacingMm": [1, 1, 1]})";
        return file;
    }

private:
    QTemporaryDir m_folder;
};

TEST_F(OpenTest, ASeriesOpensWithAllViewsAndItsGeometry) {
    window.openPaths({std::filesystem::path(PELLUCID_TEST_DATA) / "ct-head-64"});
    EXPECT_TRUE(child<QWidget>("loadBar")->isVisible());
    ASSERT_TRUE(waitLoaded());
    EXPECT_FALSE(child<QWidget>("loadBar")->isVisible());
    ASSERT_FALSE(document().isEmpty());
    EXPECT_EQ(document().volume().grid().size, glm::ivec3(64, 64, 93));
    ASSERT_TRUE(settle());
    EXPECT_EQ(axial()->letters(), (EdgeLetters{"R", "L", "A", "P"}));
    EXPECT_EQ(app::sliceRange(document().volume().grid(), app::Plane::Axial).count, 93);
}

TEST_F(OpenTest, AFailureLeavesTheDocumentAndSaysTheWholeSentence) {
    const Scene before = document().scene();
    const auto volumes = document().volumes();
    const std::filesystem::path file = writeRaw("short.raw", 20, false);
    const auto expected = io::open({file});
    ASSERT_FALSE(expected);
    window.openPaths({file});
    ASSERT_TRUE(waitLoaded());
    EXPECT_EQ(document().scene(), before);
    EXPECT_EQ(document().volumes(), volumes);
    EXPECT_TRUE(child<QWidget>("messageBar")->isVisible());
    const std::string shown = child<QLabel>("messageText")->text().toStdString();
    EXPECT_NE(shown.find(expected.error().text()), std::string::npos) << shown;
    EXPECT_EQ(shown.find("short.raw could not be opened."), 0u) << shown;
}

TEST_F(OpenTest, CancelKeepsTheDocumentAndTheWindowUsable) {
    const auto volumes = document().volumes();
    const std::filesystem::path file = writeRaw("large.raw", 300);
    int loaded = 0, failed = 0;
    QObject::connect(&window.loader(), &app::Loader::loaded, [&] { ++loaded; });
    QObject::connect(&window.loader(), &app::Loader::failed, [&] { ++failed; });
    window.openPaths({file});
    ASSERT_TRUE(window.loader().isLoading());
    child<QPushButton>("loadCancel")->click();
    EXPECT_FALSE(window.loader().isLoading());
    EXPECT_EQ(document().volumes(), volumes);
    EXPECT_EQ(child<QLabel>("messageText")->text(), QStringLiteral("Opening large.raw was cancelled."));
    // What the cancelled thread still posts comes to nothing; the next load is the one that counts.
    window.openPaths({writeRaw("small.raw", 10)});
    ASSERT_TRUE(waitLoaded());
    QTest::qWait(300);
    EXPECT_EQ(document().volume().grid().size, glm::ivec3(10));
    EXPECT_EQ(loaded, 1);
    EXPECT_EQ(failed, 1) << "the cancel itself, and nothing after it";
}

TEST_F(OpenTest, ADroppedFileOpens) {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(QString::fromStdString(writeRaw("dropped.raw", 12).string()))});
    QDragEnterEvent enter({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window, &enter);
    EXPECT_TRUE(enter.isAccepted());
    QDropEvent drop({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window, &drop);
    ASSERT_TRUE(waitLoaded());
    EXPECT_EQ(document().volume().grid().size, glm::ivec3(12));
    EXPECT_TRUE(window.windowTitle().contains(QStringLiteral("dropped")))
        << window.windowTitle().toStdString();
}

TEST_F(OpenTest, WarningsAreShownInFull) {
    const VolumePtr small = smallVolume();
    VolumeInfo info;
    info.warnings = {{"The slices are 4 mm apart but 5 mm thick."}, {"The tag (0018,0050) is missing."}};
    const VolumePtr warned = Volume::make(small->grid(), VoxelType::Int16, 1,
                                          {small->bytes().begin(), small->bytes().end()}, {}, info)
                                 .value();
    window.showScan(app::scanFrom(Scene{}, {warned}).value());
    EXPECT_EQ(child<QLabel>("messageText")->text(),
              QStringLiteral("The slices are 4 mm apart but 5 mm thick.\nThe tag (0018,0050) is missing."));
    EXPECT_TRUE(child<QWidget>("messageBar")->isVisible());
}

TEST_F(OpenTest, TheInformationNamesPlaceValuesAndWarnings) {
    const std::string text = app::scanInformation(document().volume());
    // The centre of 24 x 20 x 16 voxels of 2 x 3 x 4 mm whose first centre lies at (-20, -30, -40) mm.
    EXPECT_NE(text.find("L 3.0  A 1.5  I 10.0 mm"), std::string::npos) << text;
    EXPECT_NE(text.find("-1000 to 716 HU"), std::string::npos) << text;
}

TEST_F(OpenTest, ASavedSceneOpensAgainAsItWas) {
    window.openPaths({writeRaw("volume.raw", 12)});
    ASSERT_TRUE(waitLoaded());
    document().change("density", {}, [](Scene& scene) { scene.densityScale = 1.75; });
    document().change("view", {}, [](Scene& scene) { scene.camera.view = AnatomicalView::Left; });
    const Scene saved = document().scene();
    ASSERT_TRUE(io::saveScene(folder() / "scene.json", saved));
    window.openPaths({folder() / "scene.json"});
    ASSERT_TRUE(waitLoaded());
    EXPECT_EQ(document().sceneFile(), folder() / "scene.json");
    EXPECT_FALSE(document().isModified());
    Scene again = document().scene();
    ASSERT_EQ(again.volumes.size(), 1u);
    again.volumes.front().source = saved.volumes.front().source;  // Relative now.
    EXPECT_EQ(again, saved);
}

TEST_F(OpenTest, SeveralSeriesAreOffered) {
    std::filesystem::copy(std::filesystem::path(PELLUCID_TEST_DATA) / "ct-head-64", folder() / "a");
    writeSeries(SyntheticSeries{}, folder() / "b");
    window.openPaths({folder()});
    ASSERT_TRUE(
        waitFor([this] { return window.findChild<QDialog*>(QStringLiteral("seriesDialog")) != nullptr; }));
    auto* list = child<QListWidget>("seriesList");
    ASSERT_EQ(list->count(), 2);
    int chosen = -1;
    for (int row = 0; row < 2; ++row)
        if (list->item(row)->toolTip() == QStringLiteral("1.2.3.4.5")) chosen = row;
    ASSERT_GE(chosen, 0);
    list->setCurrentRow(chosen);
    Q_EMIT list->itemDoubleClicked(list->item(chosen));
    ASSERT_TRUE(waitLoaded());
    EXPECT_EQ(document().volume().grid().size, glm::ivec3(7, 5, 4));
}

TEST_F(OpenTest, ALargeSeriesIsSeenBeforeItIsThere) {
    SyntheticSeries series;
    series.size = {512, 512};
    series.slices = 63;
    series.value = [](int i, int j, int k) {
        return std::hypot(i - 256, j - 256, 4 * (k - 32)) < 200.0 ? 1500 : 0;
    };
    writeSeries(series, folder());
    auto* preview = child<QWidget>("coarsePreview");
    VolumePtr coarse;
    int previews = 0;
    bool wasSeen = false;
    QImage seen;
    QObject::connect(&window.loader(), &app::Loader::previewed, [&](const VolumePtr& copy) {
        ++previews;
        coarse = copy;
        EXPECT_EQ(document().volume().grid().size, smallVolume()->grid().size)
            << "the document is not touched";
    });
    QObject::connect(&window.renderService(), &app::RenderService::replied, [&] {
        if (!preview->isVisible() || wasSeen) return;
        wasSeen = true;
        seen = preview->grab().toImage();
    });
    window.openPaths({folder()});
    ASSERT_TRUE(waitLoaded());
    EXPECT_EQ(previews, 1);
    EXPECT_TRUE(waitFor([&] { return volumeView()->isSettled() && !preview->isVisible(); }));
    EXPECT_EQ(document().volume().grid().size, glm::ivec3(512, 512, 63));
    ASSERT_TRUE(coarse);
    // As dense as the whole, whose spacings are a quarter.
    EXPECT_NEAR(*app::sceneOfCoarse(coarse).unitLengthMm, *document().completeScene().unitLengthMm, 1e-12);
    if (!wasSeen) return;  // The whole was faster.
    EXPECT_GT(seen.pixelColor(seen.rect().center()).value(), 40);
    EXPECT_LT(seen.pixelColor(3, seen.height() - 4).value(), 10);
}

}  // namespace
}  // namespace pellucid::test
