// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// The error a frame states of itself, held against the reference on real scans and synthetic fields.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "accuracy/metrics.h"
#include "accuracy/reference.h"
#include "io/load.h"
#include "scene/names.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

class Estimate : public GpuTest {
protected:
    struct Tally {
        int frames = 0, outside = 0;
        std::string worst;

        /// Within a factor of 2, or both below a twentieth of a grey level, where float rounding and the
        /// reference's own bound begin.
        void judge(double estimated, double truth, const std::string& what) {
            constexpr double kNothing = 0.05 / 255.0;
            ++frames;
            if (estimated < kNothing && truth < kNothing) return;
            // Never claims to be better than it is by more than 2.
            EXPECT_GE(estimated, 0.5 * truth - kNothing) << what;
            if (estimated <= 2.0 * truth + kNothing && estimated >= 0.5 * truth - kNothing) return;
            ++outside;
            worst += fmt::format("\n{}: estimated {:.3g}, true {:.3g}", what, estimated, truth);
        }
    };

    void judgeViews(Scene scene, const VolumePtr& volume, const std::string& name, Tally& max, Tally& rmse) {
        renderer::RenderOptions options;
        options.estimateError = true;
        options.estimateReduction = 1;
        scene = completed(scene, {volume});
        scene.picture.size = {40, 40};
        for (const AnatomicalView view : {AnatomicalView::Anterior, AnatomicalView::Left}) {
            scene.camera.view = view;
            const auto reference = accuracy::referencePicture(scene, {volume}, {1e-4, 5, {}});
            ASSERT_TRUE(reference) << reference.error().text();
            for (const double step : {0.5, 1.0, 2.0}) {
                scene.quality.stepVoxels = step;
                const renderer::Frame frame = frameOf(scene, volume, options);
                ASSERT_TRUE(frame.error);
                const auto truth = accuracy::difference(frame.image, reference->image).value();
                const std::string what = fmt::format("{} {} {} step {}", name, pellucid::name(scene.mode),
                                                     pellucid::name(view), step);
                max.judge(frame.error->maxError, truth.maxError, what + " max");
                rmse.judge(frame.error->rmse, truth.rmse, what + " rmse");
            }
        }
    }
};

/// Estimated maximum and RMSE are within a factor of 2 of the true ones on at least 95 % of frames.
TEST_F(Estimate, LiesWithinAFactorOfTwo) {
    struct Source {
        std::string name;
        VolumePtr volume;
    };
    std::vector<Source> sources{{"Marschner-Lobb", accuracy::marschnerLobb(40)}};
    for (const char* path :
         {PELLUCID_SOURCE_DIR "/resources/sample/ct-torso.nii.gz", PELLUCID_TEST_DATA "/ct-head-64"}) {
        auto volume = io::loadVolume({path});
        ASSERT_TRUE(volume) << volume.error().text();
        sources.push_back({path, *volume});
    }
    Tally max, rmse;
    for (const auto& [name, volume] : sources) {
        for (const Mode mode : {Mode::Composite, Mode::XRay, Mode::Mip}) {
            for (const bool lit : {false, true}) {
                if (lit && mode != Mode::Composite) continue;
                Scene scene;
                scene.mode = mode;
                scene.lights.emplace();
                if (lit) scene.lights->push_back(Light{});
                judgeViews(scene, volume, name + (lit ? " lit" : ""), max, rmse);
            }
        }
    }
    EXPECT_LE(max.outside, max.frames / 20) << max.frames << " frames" << max.worst;
    EXPECT_LE(rmse.outside, rmse.frames / 20) << rmse.frames << " frames" << rmse.worst;
}

}  // namespace
}  // namespace pellucid::test
