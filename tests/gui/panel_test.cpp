// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QSlider>

#include "app/desktop/look_panel.h"
#include "scene/names.h"
#include "tests/gui/gui_support.h"

namespace pellucid::test {
namespace {

class PanelTest : public GuiTest {
protected:
    /// As a user does: opens the list and takes the entry.
    void choose(const char* comboBox, const QString& text) {
        auto* box = child<QComboBox>(comboBox);
        const int index = box->findText(text);
        ASSERT_GE(index, 0) << text.toStdString();
        box->setCurrentIndex(index);
        Q_EMIT box->activated(index);
    }
    bool isShown(const char* objectName) { return !child<QWidget>(objectName)->isHidden(); }
};

TEST_F(PanelTest, APresetSetsFunctionAndMaterialAsOneStep) {
    const Scene before = document().scene();
    const auto presets = app::presetsFor("CT");
    ASSERT_FALSE(presets.empty());
    EXPECT_EQ(presets.front().modality, "CT");
    const VolumePreset& preset = presets.back();
    choose("volumePreset", QString::fromStdString(preset.name));
    EXPECT_EQ(document().item().transferFunction, preset.function);
    EXPECT_EQ(document().scene().material, preset.material);
    EXPECT_EQ(document().undoStack().undoName(), "Preset: " + preset.name);
    document().undo();
    EXPECT_EQ(document().scene(), before);
    choose("volumePreset", QStringLiteral("From the data"));
    EXPECT_EQ(document().item().transferFunction, document().dataFunction());
}

TEST_F(PanelTest, AModeShowsOnlyWhatItUses) {
    const struct {
        const char* text;
        Mode mode;
        bool curve, light, isovalue, hitOpacity, xray;
    } cases[] = {{"Maximum (MIP)", Mode::Mip, false, false, false, false, false},
                 {"Isosurface", Mode::Isosurface, true, true, true, false, false},
                 {"First hit", Mode::FirstHit, true, true, false, true, false},
                 {"X-ray", Mode::XRay, true, false, false, false, true},
                 {"Emission", Mode::Emission, true, false, false, false, false},
                 {"Minimum (MinIP)", Mode::MinIp, false, false, false, false, false},
                 {"Average", Mode::Average, false, false, false, false, false},
                 {"Composite", Mode::Composite, true, true, false, false, false}};
    for (const auto& expected : cases) {
        SCOPED_TRACE(expected.text);
        choose("mode", QLatin1String(expected.text));
        EXPECT_EQ(document().scene().mode, expected.mode);
        EXPECT_EQ(isShown("curveEditor"), expected.curve);
        EXPECT_EQ(isShown("volumePreset"), expected.curve);
        EXPECT_EQ(isShown("lightPanel"), expected.light);
        EXPECT_EQ(isShown("isovalue"), expected.isovalue);
        EXPECT_EQ(isShown("hitOpacity"), expected.hitOpacity);
        EXPECT_EQ(isShown("xray"), expected.xray);
        ASSERT_TRUE(settle());
        EXPECT_FALSE(volumeView()->lastReply()->error) << volumeView()->lastReply()->error->text();
        EXPECT_EQ(volumeView()->lastReply()->frame->plan.features.mode, expected.mode);
    }
}

TEST_F(PanelTest, SeveralSurfacesHaveNoUseForIsovalueAndCurve) {
    choose("mode", QStringLiteral("Isosurface"));
    EXPECT_TRUE(isShown("isovalue") && isShown("curveEditor") && isShown("volumePreset"));
    document().changeItem("Surfaces", {}, [](VolumeItem& item) {
        item.isosurfaces = {{0.0, glm::dvec3(1.0), 0.5}, {300.0, glm::dvec3(1.0), 1.0}};
    });
    EXPECT_FALSE(isShown("isovalue") || isShown("curveEditor") || isShown("volumePreset"));
    choose("mode", QStringLiteral("Composite"));
    EXPECT_TRUE(isShown("curveEditor")) << "they belong to another mode";
}

TEST_F(PanelTest, UndoAndRedoGiveNamesAndValuesBackExactly) {
    std::vector<std::pair<std::string, Scene>> history;
    const auto remember = [&] {
        history.emplace_back(document().undoStack().undoName(), document().scene());
    };
    const Scene start = document().scene();
    choose("mode", QStringLiteral("Isosurface"));
    remember();
    childOf<QDoubleSpinBox>("isovalue", "field")->setValue(333.0);
    remember();
    choose("filter", QStringLiteral("Tricubic B-spline"));
    remember();
    childOf<QSlider>("ambient", "slider")->setValue(437);
    remember();
    child<QCheckBox>("lit")->click();
    remember();
    choose("projection", QStringLiteral("Orthographic"));
    remember();
    const std::vector<std::string> names{"Mode: Isosurface", "Isovalue",  "Interpolation: Tricubic B-spline",
                                         "Ambient",          "Light off", "Projection"};
    for (std::size_t i = 0; i < history.size(); ++i) EXPECT_EQ(history[i].first, names[i]);
    EXPECT_TRUE(document().scene().lights && document().scene().lights->empty());
    EXPECT_EQ(document().scene().material.ambient, 0.44);  // Two decimals, as the field shows.

    auto* undo = child<QAction>("undo");
    auto* redo = child<QAction>("redo");
    for (std::size_t i = history.size(); i-- > 0;) {
        EXPECT_EQ(undo->text().toStdString(), "Undo: " + history[i].first);
        undo->trigger();
        EXPECT_EQ(document().scene(), i > 0 ? history[i - 1].second : start);
    }
    EXPECT_FALSE(undo->isEnabled());
    for (const auto& [name, scene] : history) {
        EXPECT_EQ(redo->text().toStdString(), "Redo: " + name);
        redo->trigger();
        EXPECT_EQ(document().scene(), scene);
    }
    EXPECT_FALSE(redo->isEnabled());
    child<QCheckBox>("lit")->click();
    EXPECT_FALSE(document().scene().lights) << "the default headlight again";
}

TEST_F(PanelTest, ADraggedSliderIsOneStep) {
    auto* slider = childOf<QSlider>("density", "slider");
    slider->setSliderDown(true);
    for (const int step : {300, 400, 500}) slider->setSliderPosition(step);
    slider->setSliderDown(false);
    EXPECT_EQ(document().scene().densityScale, 2.0);
    document().undo();
    EXPECT_EQ(document().scene().densityScale, 1.0);
    EXPECT_FALSE(document().undoStack().canUndo());
}

TEST_F(PanelTest, QualityByErrorIsMetAndSaidInTheStatusBar) {
    EXPECT_FALSE(isShown("tolerance"));
    EXPECT_TRUE(isShown("step") && isShown("integrator"));
    choose("qualityUnit", QStringLiteral("By error"));
    EXPECT_EQ(document().undoStack().undoName(), "Quality by error");
    EXPECT_TRUE(isShown("tolerance") && isShown("toleranceNorm"));
    EXPECT_FALSE(isShown("step") || isShown("integrator"));
    EXPECT_EQ(document().scene().quality.toleranceGreyLevels, 1.0);
    // 0.1 * 200^0.75, with one decimal.
    childOf<QSlider>("tolerance", "slider")->setValue(750);
    EXPECT_EQ(document().scene().quality.toleranceGreyLevels, 5.3);
    EXPECT_EQ(document().undoStack().undoName(), "Error allowed");
    ASSERT_TRUE(settle());
    ASSERT_TRUE(volumeView()->lastReply()->frame->chosen);
    const auto says = [this](const char* text) {
        return child<QLabel>("cost")->text().contains(QLatin1String(text));
    };
    EXPECT_TRUE(says("grey levels RMS (asked 5.3), ")) << child<QLabel>("cost")->text().toStdString();
    choose("toleranceNorm", QStringLiteral("Anywhere (maximum)"));
    EXPECT_EQ(document().scene().quality.toleranceNorm, ErrorNorm::Max);
    ASSERT_TRUE(settle());
    EXPECT_TRUE(says(" at most (asked 5.3)")) << child<QLabel>("cost")->text().toStdString();
    EXPECT_FALSE(says("NOT met"));
}

TEST_F(PanelTest, QualityByStepGoesOnFromWhatWasChosen) {
    choose("qualityUnit", QStringLiteral("By error"));
    childOf<QDoubleSpinBox>("tolerance", "field")->setValue(0.3);
    ASSERT_TRUE(settle());
    const renderer::Frame& before = *volumeView()->lastReply()->frame;
    const Quality chosen = before.chosen.value();
    choose("qualityUnit", QStringLiteral("By step"));
    EXPECT_EQ(document().undoStack().undoName(), "Quality by step");
    const Quality& stated = document().scene().quality;
    EXPECT_FALSE(stated.automatic);
    EXPECT_EQ(stated.stepVoxels, chosen.stepVoxels);
    EXPECT_EQ(stated.integrator, chosen.integrator);
    EXPECT_NEAR(childOf<QDoubleSpinBox>("step", "field")->value(), chosen.stepVoxels, 0.005);
    const ImageF picture = before.image;
    ASSERT_TRUE(settle());
    EXPECT_EQ(volumeView()->lastReply()->frame->image, picture);
}

TEST_F(PanelTest, EveryIntegratorCanBeChosenWhereItCounts) {
    const auto integrators = enumNames<Integrator>();
    auto* box = child<QComboBox>("integrator");
    ASSERT_EQ(box->count(), static_cast<int>(integrators.size()));
    for (const auto& integrator : integrators) {
        choose("integrator", box->itemText(static_cast<int>(integrator.value)));
        EXPECT_EQ(document().scene().quality.integrator, integrator.value);
        EXPECT_EQ(isShown("tolerance"), keepsTolerance(integrator.value));
    }
    choose("mode", QStringLiteral("Maximum (MIP)"));
    EXPECT_FALSE(isShown("integrator") || isShown("tolerance")) << "a maximum is not integrated";
    ASSERT_TRUE(settle());
}

TEST_F(PanelTest, EveryFilterCanBeChosen) {
    EXPECT_EQ(child<QComboBox>("filter")->count(), static_cast<int>(enumNames<Filter>().size()));
}

TEST_F(PanelTest, TabGoesThroughTheQualityInTheOrderShown) {
    choose("qualityUnit", QStringLiteral("By error"));
    window.activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
    child<QWidget>("filter")->setFocus();
    QStringList order;
    for (int i = 0; i < 6; ++i) {
        QWidget* focus = QApplication::focusWidget();
        const bool isPart =
            focus->objectName() == QStringLiteral("slider") || focus->objectName() == QStringLiteral("field");
        order +=
            isPart ? focus->parentWidget()->objectName() + u'.' + focus->objectName() : focus->objectName();
        QTest::keyClick(focus, Qt::Key_Tab);
    }
    EXPECT_EQ(order.join(u' ').toStdString(),
              "filter qualityUnit tolerance.slider tolerance.field toleranceNorm space");
}

TEST_F(PanelTest, WindowFieldsAndPresetsFollowTheDocument) {
    auto* width = childOf<QDoubleSpinBox>("windowWidth", "field");
    EXPECT_EQ(width->value(), 400);
    EXPECT_EQ(child<QComboBox>("windowPreset")->currentText(), QStringLiteral("File window"));
    width->setValue(250);
    EXPECT_EQ(document().item().window, (Window{40, 250}));
    EXPECT_EQ(child<QComboBox>("windowPreset")->currentText(), QStringLiteral("Own"));
    choose("windowPreset", QStringLiteral("Bone"));
    EXPECT_EQ(document().item().window, (Window{350, 2000}));
}

TEST_F(PanelTest, CtWindowsAreOnlyOfferedForHounsfieldValues) {
    EXPECT_GE(child<QComboBox>("windowPreset")->findText(QStringLiteral("Lung")), 0);
    app::OpenedScan scan = smallScan();
    Volume::make(scan.volumes.front()->grid(), VoxelType::Int16, 1,
                 {scan.volumes.front()->bytes().begin(), scan.volumes.front()->bytes().end()}, {},
                 {"plain", "MR", {}, {}, {}})
        .map([&](const VolumePtr& plain) { window.showScan(app::scanFrom(Scene{}, {plain}).value()); });
    EXPECT_LT(child<QComboBox>("windowPreset")->findText(QStringLiteral("Lung")), 0);
    const auto before = document().item().window;
    QTest::keyClick(axial(), Qt::Key_2);
    EXPECT_EQ(document().item().window, before);
}

}  // namespace
}  // namespace pellucid::test
