// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "accuracy/report_analysis.h"
#include "accuracy/report_plan.h"
#include "accuracy/report_reference.h"
#include "accuracy/report_svg.h"

namespace pellucid::accuracy {
namespace {

using testing::ElementsAre;

TEST(ReportOrder, IsTheSlopeOfTheFinePart) {
    // Second order in the fine part, a coarse point far off it, and one below the floor.
    const auto found =
        observedOrder({{4, 0.9}, {1, 0.01}, {0.5, 0.0025}, {0.25, 0.000625}, {0.125, 1e-7}}, 1e-5);
    ASSERT_TRUE(found.order);
    EXPECT_NEAR(*found.order, 2.0, 1e-12);
    EXPECT_EQ(found.points, 3);  // (4, 0.9) has a local slope of 3.2
}

TEST(ReportOrder, FitsScatterByLeastSquares) {
    // log2 errors -10, -8.2, -6 at log2 steps -2, -1, 0: slope (4 + 0) / 2 = 2, by hand.
    const auto found =
        observedOrder({{0.25, std::exp2(-10)}, {0.5, std::exp2(-8.2)}, {1.0, std::exp2(-6)}}, 0.0);
    ASSERT_TRUE(found.order);
    EXPECT_NEAR(*found.order, 2.0, 1e-12);
}

TEST(ReportOrder, IsNotGuessedFromOnePointOrNone) {
    EXPECT_FALSE(observedOrder({{1, 0.1}, {0.5, 1e-9}}, 1e-6).order);
    EXPECT_FALSE(observedOrder({}, 0.0).order);
    EXPECT_FALSE(observedOrder({{1, std::nan("")}, {0.5, 0.0}}, 0.0).order);
}

TEST(ReportFront, HoldsWhatNothingBeats) {
    const std::vector<TimeError> points{{10, 0.1}, {5, 0.2}, {20, 0.1}, {7, 0.3}, {40, 0.01}, {5, 0.2}};
    EXPECT_THAT(paretoFront(points), ElementsAre(1, 0, 4));
    EXPECT_TRUE(paretoFront({}).empty());
}

TEST(ReportTime, IsInterpolatedInTheLogarithms) {
    const std::vector<TimeError> curve{{1, 0.1}, {100, 0.001}};
    const auto middle = timeToError(curve, 0.01);
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->ms, 10.0, 1e-12);
    EXPECT_FALSE(middle->atMost);
    const auto coarse = timeToError(curve, 0.5);
    ASSERT_TRUE(coarse);
    EXPECT_EQ(coarse->ms, 1.0);
    EXPECT_TRUE(coarse->atMost);
    EXPECT_FALSE(timeToError(curve, 1e-4));
    EXPECT_FALSE(timeToError({}, 1.0));
}

TEST(ReportTime, DoesNotNeedACurveThatFallsAlways) {
    // Better and cheaper at a finer step: that point itself is the way.
    const std::vector<TimeError> curve{{8, 0.1}, {4, 0.005}, {16, 0.02}};
    const auto time = timeToError(curve, 0.01);
    ASSERT_TRUE(time);
    EXPECT_EQ(time->ms, 4.0);
}

TEST(ReportStalls, ArePredictedFromHalfAUnit) {
    EXPECT_NEAR(predictedStall(Accumulation::EightBit, 0.01, 4000), 1.0 - 0.5 / 2.55, 1e-12);
    EXPECT_NEAR(predictedStall(Accumulation::EightBit, 0.001, 4000), 0.0, 1e-12);
    EXPECT_NEAR(predictedStall(Accumulation::Half, 0.001, 4000), 1.0 - 1000.0 / 4096.0, 1e-12);
    // Too few layers to get there, and a format that does not stall.
    EXPECT_NEAR(predictedStall(Accumulation::Half, 0.01, 10), 1.0 - std::pow(0.99, 10), 1e-12);
    EXPECT_NEAR(predictedStall(Accumulation::Float32, 0.001, 4000), 1.0 - std::pow(0.999, 4000), 1e-12);
}

Scene compositeScene(Mode mode = Mode::Composite) {
    Scene scene;
    scene.volumes.emplace_back();
    scene.volumes.front().transferFunction =
        TransferFunction1D{"", "", {{0, {1, 1, 1}, 0}, {1, {1, 1, 1}, 1}}};
    scene.lights.emplace();
    scene.mode = mode;
    return scene;
}

TEST(ReportPlan, CoversEveryCombinationOnce) {
    const Scene scene = compositeScene();
    const auto settings = reportSettings(scene, fullScope(scene));
    // 8 integrators with 6 steps and one with 6 tolerances, 5 filters, 3 formats; one with 6
    // tolerances on 2 filters; 3 more filters with one
    // integrator and format; 6 steps with jitter and 6 tolerances for automatic.
    EXPECT_EQ(settings.size(), (9u * 5 + 2) * 6 * 3 + 3 * 6 + 6 + 6);
    std::set<std::string> names;
    for (const ReportSetting& setting : settings) names.insert(settingName(setting));
    EXPECT_EQ(names.size(), settings.size());
}

TEST(ReportPlan, ASceneThatChoosesItselfIsMeasuredAtEachSetting) {
    Scene scene = compositeScene();
    scene.quality.automatic = true;
    scene.quality.stepMm = 3.0;
    for (const ReportSetting& setting : reportSettings(scene, quickScope(scene))) {
        const Quality quality = sceneWith(scene, setting, {8, 8}).quality;
        EXPECT_EQ(quality.automatic, methodName(setting) == "automatic");
        EXPECT_EQ(quality.toleranceGreyLevels, setting.tolerance);
        EXPECT_FALSE(quality.stepMm);
    }
}

TEST(ReportReference, IsThatOfTheSameFieldAndLight) {
    Scene scene = compositeScene();
    scene.lights->clear();
    ReportSetting setting;
    setting.filter = Filter::TricubicBSplineLut;
    EXPECT_EQ(referenceOf(setting, scene), (ReferenceKind{Filter::TricubicBSpline, false, false}));
    setting = {};
    setting.renderer = "vtk-gpu";
    EXPECT_EQ(referenceOf(setting, scene), (ReferenceKind{Filter::Trilinear, true, false}));
    scene.lights->emplace_back();
    EXPECT_EQ(referenceOf(setting, scene), (ReferenceKind{Filter::Trilinear, true, true}));
    setting.renderer = "vtk-fixed-point";
    EXPECT_EQ(referenceOf(setting, scene), (ReferenceKind{Filter::Trilinear, true, false}));
}

TEST(ReportPlan, LeavesOutWhatAProjectionDoesNotHave) {
    const Scene mip = compositeScene(Mode::Mip);
    const auto settings = reportSettings(mip, fullScope(mip));
    EXPECT_EQ(settings.size(), 6u * 8 + 6 + 6);  // Steps and filters; jitter; tolerances.
    for (const ReportSetting& setting : settings) EXPECT_EQ(setting.integrator, Integrator::Exponential);
    const Scene slice = compositeScene(Mode::Slice);
    EXPECT_EQ(reportSettings(slice, fullScope(slice)).size(), 8u);
}

TEST(ReportPlan, QuickSaysWhatItLeftOut) {
    Scene scene = compositeScene();
    scene.picture.size = {1000, 500};
    const ReportScope scope = quickScope(scene);
    EXPECT_EQ(scope.pictureSize, glm::ivec2(128, 64));
    EXPECT_GE(scope.reductions.size(), 4u);
    EXPECT_LT(reportSettings(scene, scope).size(), 70u);
}

TEST(ReportAnalysis, NamesWhyAnOrderIsBelowTheory) {
    Scene scene = compositeScene();
    EXPECT_EQ(unsmoothness(scene, Filter::TricubicBSpline), "the transfer function has kinks");
    scene.volumes.front().transferFunction->points.push_back({1, {1, 1, 1}, 5});
    EXPECT_THAT(unsmoothness(scene, Filter::Trilinear), testing::HasSubstr("the transfer function jumps"));

    ReportData data;
    data.scope = quickScope(scene);
    for (const double step : {2.0, 1.0, 0.5}) {
        Measurement m;
        m.setting.integrator = Integrator::Simpson;
        m.setting.stepVoxels = m.stepMm = step;
        m.wallMs = 10.0 / step;
        m.rmse = 0.01 * step;
        data.measurements.push_back(m);
    }
    const ReportAnalysis analysis = analyse(data, scene);
    ASSERT_EQ(analysis.series.size(), 1u);
    EXPECT_NEAR(analysis.series.front().order.order.value(), 1.0, 1e-12);
    EXPECT_EQ(analysis.series.front().theory, 4.0);
    EXPECT_THAT(analysis.series.front().remark,
                testing::StartsWith("not smooth: the transfer function jumps"));
    EXPECT_NEAR(analysis.series.front().timesToError[1]->ms, 10.0, 1e-12);  // RMSE 0.01 at step 1
    EXPECT_THAT(analysis.fronts.front(), ElementsAre(0, 1, 2));
}

TEST(ReportSvg, LeavesOutWhatALogarithmCannotShow) {
    const Plot plot{
        "p", "x < 1", "y", {{"a & b", {{1, 0, "zero"}, {10, 0.1, "ten"}, {100, 0.01, "hundred"}}}}, {}, {}};
    const std::string svg = svgOf(plot);
    EXPECT_THAT(svg, testing::HasSubstr("a &amp; b"));
    EXPECT_THAT(svg, testing::HasSubstr("x &lt; 1"));
    EXPECT_THAT(svg, testing::HasSubstr("hundred"));
    EXPECT_THAT(svg, testing::Not(testing::HasSubstr("zero")));
    EXPECT_THAT(svg, testing::Not(testing::HasSubstr("nan")));
    // Nothing to show is still a picture.
    EXPECT_THAT(svgOf({"empty", "x", "y", {}, {}, {}}), testing::HasSubstr("</svg>"));
}

}  // namespace
}  // namespace pellucid::accuracy
