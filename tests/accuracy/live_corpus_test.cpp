// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// What frames state of their error, and tolerances asked for, over the real scans of the corpus.
#include "io/load.h"
#include "renderer/automatic_quality.h"
#include "tests/accuracy/estimate_judge.h"
#include "tests/support/corpus.h"

namespace pellucid::test {
namespace {

struct Source {
    std::string name;
    VolumePtr volume;
};

class LiveCorpus : public GpuTest {
protected:
    static std::vector<Source> sources() {
        std::vector<Source> found{{"Marschner-Lobb", accuracy::marschnerLobb(64)}};
        for (const char* path :
             {"ct-head-64", "ct-head-phantom/series-5mm-jpegll", "mr-head-mprage-jpegll",
              "ct-torso-nifti/example_ct.nii.gz", "ct-aorta-nifti/ct_cropped.nii.gz",
              "mr-brain-stroke/FLAIR.nii.gz", "mr-head-seg3d/MR.nii.gz",
              "mr-macaque-inia19/inia19-t1-brain.nii.gz", "volvis/engine.nii.gz", "volvis/tooth.nhdr"}) {
            auto volume = io::loadVolume({corpus() / path});
            EXPECT_TRUE(volume) << volume.error().text();
            if (volume) found.push_back({path, *volume});
        }
        return found;
    }
};

TEST_F(LiveCorpus, EstimatesLieWithinAFactorOfTwo) {
    EstimateJudge judge;
    for (const Source& source : sources()) {
        const auto draw = [&](const Scene& scene) {
            renderer::RenderOptions options;
            options.estimateError = true;
            options.estimateReduction = 1;
            return frameOf(scene, source.volume, options);
        };
        const std::vector<AnatomicalView> views{AnatomicalView::Anterior, AnatomicalView::Left,
                                                AnatomicalView::Superior};
        for (const Mode mode : {Mode::Composite, Mode::XRay, Mode::Mip, Mode::Average})
            judge.judgeViews(sceneIn(mode, false), source.volume, source.name, views, draw);
        judge.judgeViews(sceneIn(Mode::Composite, true), source.volume, source.name + " lit", views, draw);
        Scene integrals = sceneIn(Mode::Composite, false);
        integrals.quality.integrator = Integrator::IntegralFunctions;
        judge.judgeViews(integrals, source.volume, source.name + " integrals", views, draw);
    }
    judge.max.expectGood("maximum");
    judge.rmse.expectGood("RMSE");
}

/// The largest error of lit scans needs the shortest steps: down to a 40th of a voxel, and a quarter of that
/// for the estimate.
TEST_F(LiveCorpus, LargestErrorsAskedForAreMetOnLitScans) {
    for (const Source& source : sources()) {
        Scene scene = completed(sceneIn(Mode::Composite, true), {source.volume});
        scene.picture.size = {40, 40};
        scene.camera.view = AnatomicalView::Anterior;
        const auto reference = accuracy::referencePicture(scene, {source.volume}, {1e-4, 5, {}});
        ASSERT_TRUE(reference) << reference.error().text();
        scene.quality.automatic = true;
        scene.quality.toleranceNorm = ErrorNorm::Max;
        for (const double greyLevels : {1.0, 2.0, 4.0}) {
            scene.quality.toleranceGreyLevels = greyLevels;
            const renderer::Frame frame = frameOf(scene, source.volume);
            ASSERT_TRUE(frame.error && frame.chosen);
            const auto truth = accuracy::difference(frame.image, reference->image).value();
            const std::string what = fmt::format("{} at {}: {} steps of {:.3g}, estimated {:.3g}",
                                                 source.name, greyLevels, name(frame.chosen->integrator),
                                                 frame.chosen->stepVoxels, 255.0 * frame.error->maxError);
            EXPECT_TRUE(renderer::meetsTolerance(scene.quality, *frame.error)) << what;
            EXPECT_LE(255.0 * truth.maxError, greyLevels + 0.03) << what;
        }
    }
}

TEST_F(LiveCorpus, TolerancesAskedForAreMet) {
    for (const Source& source : sources()) {
        for (const Mode mode : {Mode::Composite, Mode::XRay, Mode::Mip}) {
            for (const bool lit : {false, true}) {
                if (lit && mode != Mode::Composite) continue;
                Scene scene = completed(sceneIn(mode, lit), {source.volume});
                scene.picture.size = {40, 40};
                scene.quality.automatic = true;
                for (const AnatomicalView view : {AnatomicalView::Anterior, AnatomicalView::Superior}) {
                    scene.camera.view = view;
                    const auto reference = accuracy::referencePicture(scene, {source.volume}, {1e-4, 5, {}});
                    ASSERT_TRUE(reference) << reference.error().text();
                    for (const double greyLevels : {1.0, 4.0}) {
                        scene.quality.toleranceGreyLevels = greyLevels;
                        const renderer::Frame frame = frameOf(scene, source.volume);
                        ASSERT_TRUE(frame.error && frame.chosen);
                        const auto truth = accuracy::difference(frame.image, reference->image).value();
                        // The reference's own bound is 0.03 grey levels.
                        EXPECT_LE(255.0 * truth.rmse, greyLevels + 0.03)
                            << fmt::format("{} {} lit {} {} at {}, estimated {:.3g}, met {}", source.name,
                                           name(mode), lit, name(view), greyLevels, 255.0 * frame.error->rmse,
                                           renderer::meetsTolerance(scene.quality, *frame.error));
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace pellucid::test
