// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/report_run.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

using testing::HasSubstr;

/// A report of three steps of one integrator.
class ReportRunTest : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        m_folder = std::filesystem::temp_directory_path() /
                   testing::UnitTest::GetInstance()->current_test_info()->name();
        std::filesystem::remove_all(m_folder);
        std::filesystem::create_directories(m_folder);
    }
    void TearDown() override { std::filesystem::remove_all(m_folder); }

    accuracy::ReportData measured(double mostFrameSeconds, double mostReferenceSeconds) {
        accuracy::ReportJob job;
        job.volume = accuracy::sampledVolume(axisAlignedGrid(glm::ivec3(8)), VoxelType::UInt8,
                                             [](glm::ivec3 i) { return 30.0 * i.x; });
        Scene scene;
        scene.mode = Mode::Average;
        job.scene = completed(scene, {job.volume});
        job.scope.integrators = {Integrator::Exponential};
        job.scope.filters = {Filter::Trilinear};
        job.scope.steps = {4.0, 2.0, 1.0};
        job.scope.pictureSize = {16, 16};
        job.scope.warmFrames = 1;
        job.scope.jitter = false;
        job.scope.mostFrameSeconds = mostFrameSeconds;
        job.scope.mostReferenceSeconds = mostReferenceSeconds;
        job.folder = m_folder;
        job.files.writePng = [](const std::filesystem::path&, const Image8&) { return Result<void>(); };
        job.files.writeFloat = [](const std::filesystem::path&, const ImageF&) { return Result<void>(); };
        auto data = accuracy::measureReport(job, gpu());
        EXPECT_TRUE(data);
        return data ? *data : accuracy::ReportData();
    }

private:
    std::filesystem::path m_folder;
};

TEST_F(ReportRunTest, StepsWhoseFramesWouldTakeTooLongAreLeftOut) {
    const auto data = measured(1e-9, 900.0);
    // How long a frame takes is not known before the first.
    ASSERT_EQ(data.measurements.size(), 1u);
    EXPECT_EQ(data.measurements.front().setting.stepVoxels, 4.0);
    ASSERT_EQ(data.leftOut.size(), 2u);
    EXPECT_EQ(data.leftOut.front().setting.stepVoxels, 2.0);
    EXPECT_THAT(data.leftOut.front().why, HasSubstr("a frame would take about"));
}

TEST_F(ReportRunTest, FiltersWhoseReferenceWouldTakeTooLongAreLeftOut) {
    const auto data = measured(10.0, 1e-9);
    EXPECT_TRUE(data.measurements.empty());
    ASSERT_EQ(data.leftOut.size(), 3u);
    EXPECT_THAT(data.leftOut.back().why, HasSubstr("its reference would take about"));
}

TEST_F(ReportRunTest, NothingElseIsLeftOut) {
    const auto data = measured(10.0, 900.0);
    EXPECT_EQ(data.measurements.size(), 3u);
    EXPECT_TRUE(data.leftOut.empty());
}

}  // namespace
}  // namespace pellucid::test
