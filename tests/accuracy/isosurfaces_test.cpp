// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Several semi-transparent isosurfaces (docs/equations.md, 23) against closed forms and the reference.
#include <gtest/gtest.h>

#include "accuracy/reference.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

class Isosurfaces : public GpuTest {};

const std::vector<SurfaceLayer>& threeSurfaces() {
    static const std::vector<SurfaceLayer> surfaces{
        {0.5, {0.1, 0.9, 0.2}, 0.4}, {0.3, {0.2, 0.3, 1.0}, 0.3}, {0.7, {1.0, 0.2, 0.1}, 0.5}};
    return surfaces;
}

Scene shells(const Grid& grid, glm::ivec2 size, double heightMm) {
    Scene scene =
        sceneOf(linearExtinction({1, 1, 1}, 1.0), orthographicAlong(grid, {0.0, 1.0, 0.0}, heightMm), size);
    scene.mode = Mode::Isosurface;
    scene.volumes.front().isosurfaces = threeSurfaces();
    return scene;
}

/// 1 in the centre, 0 at 20 mm and beyond: surfaces are spheres of radius 20 (1 - value).
VolumePtr cone() {
    return accuracy::sampledVolume(axisAlignedGrid({48, 48, 48}), VoxelType::Float32, [](glm::ivec3 i) {
        return std::max(0.0, 1.0 - glm::length(glm::dvec3(i) - 23.5) / 20.0);
    });
}

/// B4.8a: a ray at a distance from the centre of concentric shells crosses each whose radius is larger twice,
/// from the outer in and out again. The colours of three surfaces tell which, how often and in which order.
TEST_F(Isosurfaces, ConcentricShellsAppearOnceInOrderAndInPlace) {
    const VolumePtr volume = cone();
    const double heightMm = 40.0;
    const int width = 400;
    Scene scene = shells(volume->grid(), {width, 1}, heightMm / width);
    const auto expected = [&](double distance) {
        std::vector<SurfaceLayer> met;
        for (const double value : {0.3, 0.5, 0.7})
            for (const SurfaceLayer& surface : threeSurfaces())
                if (surface.value == value && 20.0 * (1.0 - value) > distance) met.push_back(surface);
        for (std::size_t i = met.size(); i-- > 0;) met.push_back(met[i]);
        glm::dvec4 seen(0.0);
        for (const SurfaceLayer& surface : met)
            seen += (1.0 - seen.a) * surface.opacity * glm::dvec4(surface.color, 1.0);
        return seen;
    };
    for (const double step : {0.5, 1.0}) {
        scene.quality.stepVoxels = step;
        const ImageF image = draw(scene, volume);
        for (int x = 0; x < width; ++x) {
            // The row of rays runs through the centre; pixels are 0.1 mm wide. Trilinear interpolation moves
            // the sphere of radius r inwards by 1 / (4 r) voxel at most, and where a ray only touches, the
            // two crossings may lie within one step.
            const double distance = std::abs(heightMm / width * (x + 0.5) - heightMm / 2.0);
            bool nearEdge = false;
            for (const double radius : {6.0, 10.0, 14.0}) {
                const double touched = step * step / (8.0 * radius);  // half a chord of half a step
                nearEdge = nearEdge || std::abs(distance - radius) < 0.1 + touched;
            }
            if (nearEdge) continue;
            const glm::dvec4 found(image.at(x, 0));
            for (int c = 0; c < 4; ++c)
                ASSERT_NEAR(found[c], expected(distance)[c], 1e-5) << x << ' ' << step;
        }
    }
}

/// Where they lie along the ray: the shade of a surface is that of its own place, so a light of one point
/// tells. Against the reference, whose roots are exact to the last bit: at half a voxel the two miss or find
/// a grazing pair of crossings in few pixels; elsewhere normals at places 1e-4 voxel apart.
TEST_F(Isosurfaces, AgreeWithTheReferenceInEveryFilterLitOrNot) {
    const VolumePtr random = accuracy::randomVolume(axisAlignedGrid({12, 12, 12}, {0.9, 1.0, 1.2}), 3);
    for (const Filter filter : allFilters())
        for (const bool lit : {false, true})
            for (const CompositingSpace space : {CompositingSpace::Display, CompositingSpace::Linear}) {
                if (space == CompositingSpace::Linear && (lit || filter != Filter::Trilinear)) continue;
                if (lit && filter == Filter::Nearest)
                    continue;  // which voxel's normal is a matter of rounding
                Scene scene = sceneOf(linearExtinction({1, 1, 1}, 1.0),
                                      perspectiveAlong(random->grid(), {0.4, 1.0, -0.3}, 3.5), {12, 12});
                scene.mode = Mode::Isosurface;
                scene.space = space;
                scene.picture.background = {0.3, 0.1, 0.5};
                scene.volumes.front().filter = filter;
                scene.volumes.front().isosurfaces = threeSurfaces();
                if (lit) scene.lights->push_back(Light{});
                scene.quality.stepVoxels = 1.0 / 64.0;
                const auto exact = accuracy::referencePicture(scene, {random}, {1e-3, 2, {}});
                ASSERT_TRUE(exact) << exact.error().text();
                EXPECT_LE(shareBeyond(draw(scene, random), exact->image, 1.0 / 255.0), 0.03)
                    << name(filter) << " lit " << lit << " linear " << (space == CompositingSpace::Linear)
                    << " worst " << largestDifference(draw(scene, random), exact->image);
            }
}

/// Values that lie on an isovalue exactly, at segment ends: a plateau, a touch from below and one from above
/// count as the inside that a value reaches, never twice and never half.
TEST_F(Isosurfaces, ValuesOnTheIsovalueCountOnce) {
    struct Case {
        std::vector<double> voxels;
        int crossings;
    };
    for (const Case& c : {Case{{0, 0.5, 0.5, 0.5, 1, 1}, 1},  // up, over a plateau on the isovalue
                          Case{{0, 0.5, 0.5, 0.5, 0, 0}, 2},  // up to it and down again
                          Case{{1, 0.5, 0.5, 0.5, 0, 0}, 1},  // down
                          Case{{1, 1, 0.5, 1, 1, 1}, 0},      // touches it from above: always inside
                          Case{{1, 1, 0.25, 1, 1, 1}, 2}}) {
        const VolumePtr volume =
            accuracy::sampledVolume(axisAlignedGrid({1, 6, 1}), VoxelType::Float32,
                                    [&](glm::ivec3 i) { return c.voxels[static_cast<std::size_t>(i.y)]; });
        Scene scene = rayScene(linearExtinction({1, 1, 1}, 1.0), volume->grid(), {0, 1, 0});
        scene.camera.pose->heightMm = 0.5;
        scene.mode = Mode::Isosurface;
        scene.volumes.front().isosurfaces = {{0.5, {1, 1, 1}, 0.5}};
        for (const double step : {0.125, 0.25, 0.5}) {  // ends of segments fall on voxel centres
            scene.quality.stepVoxels = step;
            EXPECT_NEAR(drawRay(scene, volume).a, 1.0 - std::pow(0.5, c.crossings), 1e-6)
                << c.crossings << ' ' << step;
            const auto exact = accuracy::referencePicture(scene, {volume}, {1e-4, 2, {}});
            EXPECT_NEAR(static_cast<double>(exact->image.at(0, 0).a), 1.0 - std::pow(0.5, c.crossings), 1e-6);
        }
    }
}

/// An opaque surface in the list is the opaque isosurface, wherever a ray starts outside of it.
TEST_F(Isosurfaces, AnOpaqueOneIsTheSurfaceOfTheIsovalue) {
    const VolumePtr volume = cone();
    Scene scene = shells(volume->grid(), {40, 40}, 40.0);
    scene.lights->push_back(Light{});
    scene.volumes.front().isosurfaces = {{0.4, {1, 1, 1}, 1.0}};
    const ImageF one = draw(scene, volume);
    scene.volumes.front().isosurfaces.clear();
    scene.volumes.front().isovalue = 0.4;
    // Normals at places some 1e-6 of a step apart.
    EXPECT_LE(shareBeyond(draw(scene, volume), one, 1e-4), 0.01);
}

}  // namespace
}  // namespace pellucid::test
