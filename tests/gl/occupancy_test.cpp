// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Value ranges of blocks, what of them can show, and how far the next block is that can: against brute force.
#include "renderer/resources/occupancy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "renderer/plan/shown_values.h"
#include "renderer/plan/transfer_table.h"
#include "renderer/resources/texel.h"
#include "scene/names.h"
#include "tests/gl/scenes.h"

namespace pellucid::renderer {
namespace {

template <class T>
VolumePtr randomVolume(glm::ivec3 size, VoxelType type, int components, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<T> voxels(static_cast<std::size_t>(size.x * size.y * size.z * components));
    for (T& v : voxels) {
        v = static_cast<T>(random() % 1000) / static_cast<T>(std::is_integral_v<T> ? 8 : 7);
        if constexpr (!std::is_integral_v<T>) {
            if (random() % 9 == 0) v = std::numeric_limits<T>::quiet_NaN();
            if (random() % 9 == 0) v = -std::numeric_limits<T>::infinity();
        }
    }
    const auto* bytes = reinterpret_cast<const std::byte*>(voxels.data());
    return Volume::make(axisAlignedGrid(size), type, components,
                        std::vector<std::byte>(bytes, bytes + voxels.size() * sizeof(T)))
        .value();
}

/// u of a voxel as the texture has it.
double texelOf(const Volume& volume, glm::ivec3 index, int component) {
    const auto map = storedFromTexel(volume.type(), volume.storedRange(component));
    const double stored = volume.stored(index, component);
    if (isStoredIn16Bits(volume.type())) return (stored - map.offset) / map.scale;
    return static_cast<double>(FloatTexel{map}(stored));
}

void expectRangesOfBruteForce(const Volume& volume, int component, int padding) {
    const BlockRanges ranges = blockRanges(volume, component, padding);
    const glm::ivec3 size = volume.grid().size;
    ASSERT_EQ(ranges.blocks, (size + 3) / 4);
    std::size_t at = 0;
    for (int z = 0; z < ranges.blocks.z; ++z)
        for (int y = 0; y < ranges.blocks.y; ++y)
            for (int x = 0; x < ranges.blocks.x; ++x, ++at) {
                const glm::ivec3 from = glm::max(glm::ivec3(x, y, z) * 4 - padding, 0);
                const glm::ivec3 to = glm::min(glm::ivec3(x, y, z) * 4 + 4 + padding, size);
                double lo = 2.0, hi = -1.0;
                for (int k = from.z; k < to.z; ++k)
                    for (int j = from.y; j < to.y; ++j)
                        for (int i = from.x; i < to.x; ++i) {
                            lo = std::min(lo, texelOf(volume, {i, j, k}, component));
                            hi = std::max(hi, texelOf(volume, {i, j, k}, component));
                        }
                // Rounded outwards to quanta; what is one already stays (1e-6 forgives the division).
                EXPECT_EQ(ranges.lo[at], std::floor(65535.0 * lo + 1e-6));
                EXPECT_EQ(ranges.hi[at], std::ceil(65535.0 * hi - 1e-6));
            }
}

TEST(BlockRanges, AreThoseOfBruteForceInEveryTypeAndShape) {
    for (const glm::ivec3 size : {glm::ivec3(13, 6, 9), glm::ivec3(1), glm::ivec3(1, 21, 2), glm::ivec3(8)})
        for (const int padding : {1, 2}) {
            expectRangesOfBruteForce(*randomVolume<std::uint8_t>(size, VoxelType::UInt8, 1, 1), 0, padding);
            expectRangesOfBruteForce(*randomVolume<std::int8_t>(size, VoxelType::Int8, 1, 2), 0, padding);
            expectRangesOfBruteForce(*randomVolume<std::uint16_t>(size, VoxelType::UInt16, 3, 3), 2, padding);
            expectRangesOfBruteForce(*randomVolume<std::int16_t>(size, VoxelType::Int16, 2, 4), 1, padding);
            expectRangesOfBruteForce(*randomVolume<std::int32_t>(size, VoxelType::Int32, 1, 5), 0, padding);
            expectRangesOfBruteForce(*randomVolume<float>(size, VoxelType::Float32, 1, 6), 0, padding);
            expectRangesOfBruteForce(*randomVolume<double>(size, VoxelType::Float64, 4, 7), 3, padding);
        }
}

TEST(BlockRanges, CancelGivesNoBlocks) {
    const auto volume = test::makeVolume({4, 400, 400}, [](int, int, int) { return 0; });
    EXPECT_TRUE(blockRanges(*volume, 0, 1, [](double, std::string_view) { return false; }).lo.empty());
}

TEST(Occupancy, AnIntervalShowsWhenItMeetsAShownOne) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-0.3, 1.3);
    for (int turn = 0; turn < 50; ++turn) {
        std::vector<ValueRange> shown;
        for (auto n = random() % 4; n > 0; --n) {
            const double a = place(random);
            shown.push_back({a, a + (random() % 2 == 0 ? 0.0 : 0.2 * place(random) + 0.06)});
        }
        if (turn % 10 == 0) shown.push_back({0.9, std::numeric_limits<double>::infinity()});
        const ShownQuanta quanta(shown);
        for (int question = 0; question < 200; ++question) {
            const int lo = static_cast<int>(random() % 65536);
            const int hi = std::min(65535, lo + static_cast<int>(random() % (question % 2 == 0 ? 4 : 9000)));
            // What is below 0 or above 1 lies in the first or last quantum. Within two quanta both answers
            // are right.
            const auto meets = [&](double margin) {
                return std::any_of(shown.begin(), shown.end(), [&](const ValueRange& range) {
                    const double from = std::clamp(65535.0 * range.lo, 0.0, 65535.0);
                    const double to = std::clamp(65535.0 * range.hi, 0.0, 65535.0);
                    return from - margin <= hi && to + margin >= lo;
                });
            };
            if (meets(0.0)) {
                EXPECT_TRUE(quanta.any(lo, hi));
            }
            if (!meets(2.0)) {
                EXPECT_FALSE(quanta.any(lo, hi));
            }
        }
    }
}

TEST(Occupancy, DistancesAndBoxAreThoseOfBruteForce) {
    std::mt19937 random(11);
    for (const int sparseness : {1, 3, 40, 400, 1 << 30}) {
        BlockRanges ranges;
        ranges.blocks = {17, 9, 13};
        std::vector<glm::ivec3> occupied;
        for (int z = 0; z < 13; ++z)
            for (int y = 0; y < 9; ++y)
                for (int x = 0; x < 17; ++x) {
                    const bool shows =
                        random() % static_cast<std::uint32_t>(sparseness) == 0 && sparseness < 1000;
                    ranges.lo.push_back(100);
                    ranges.hi.push_back(shows ? 30000 : 200);
                    if (shows) occupied.emplace_back(x, y, z);
                }
        const std::vector<ValueRange> shown{{0.4, 0.5}};
        const Occupancy found = occupancyOf(ranges, ShownQuanta(shown), 0.0);
        EXPECT_EQ(found.occupied, occupied.size());
        glm::ivec3 lo(100), hi(0);
        for (const glm::ivec3 at : occupied) {
            lo = glm::min(lo, at);
            hi = glm::max(hi, at + 1);
        }
        EXPECT_EQ(found.boxLo, occupied.empty() ? glm::ivec3(0) : lo);
        EXPECT_EQ(found.boxHi, hi);
        std::size_t index = 0;
        for (int z = 0; z < 13; ++z)
            for (int y = 0; y < 9; ++y)
                for (int x = 0; x < 17; ++x, ++index) {
                    int nearest = 255;
                    for (const glm::ivec3 at : occupied) {
                        const glm::ivec3 apart = glm::abs(at - glm::ivec3(x, y, z));
                        nearest = std::min(nearest, std::max({apart.x, apart.y, apart.z}));
                    }
                    ASSERT_EQ(found.distance[index], nearest) << x << ' ' << y << ' ' << z;
                }
    }
}

/// An octree of value ranges over blocks (Engel et al. 2006, section 7.3.4), every node from the voxels.
class BruteForceOctree {
public:
    BruteForceOctree(const Volume& volume, ValueRange shown) : m_size(volume.grid().size.x), m_shown(shown) {
        for (int k = 0; k < m_size; ++k)
            for (int j = 0; j < m_size; ++j)
                for (int i = 0; i < m_size; ++i) m_texels.push_back(texelOf(volume, {i, j, k}, 0));
        for (int edge = kBlockEdge; edge <= m_size; edge *= 2) {
            const int nodes = m_size / edge;
            m_empty.emplace_back();
            for (int z = 0; z < nodes; ++z)
                for (int y = 0; y < nodes; ++y)
                    for (int x = 0; x < nodes; ++x)
                        m_empty.back().push_back(isEmpty(glm::ivec3(x, y, z) * edge, edge));
        }
    }

    [[nodiscard]] int levels() const { return static_cast<int>(m_empty.size()); }
    /// Whether the node that holds a block shows nothing.
    [[nodiscard]] bool isEmptyAt(int level, glm::ivec3 block) const {
        const int nodes = m_size / kBlockEdge >> level;
        const glm::ivec3 at(block.x >> level, block.y >> level, block.z >> level);
        return m_empty[static_cast<std::size_t>(level)]
                      [static_cast<std::size_t>((at.z * nodes + at.y) * nodes + at.x)];
    }
    [[nodiscard]] double texel(glm::ivec3 i) const {
        return m_texels[static_cast<std::size_t>((i.z * m_size + i.y) * m_size + i.x)];
    }

private:
    /// With the voxel beyond each side that trilinear interpolation reads, and two quanta more than is shown.
    [[nodiscard]] bool isEmpty(glm::ivec3 from, int edge) const {
        double lo = 2.0, hi = -1.0;
        const glm::ivec3 first = glm::max(from - 1, 0), end = glm::min(from + edge + 1, m_size);
        for (int k = first.z; k < end.z; ++k)
            for (int j = first.y; j < end.y; ++j)
                for (int i = first.x; i < end.x; ++i) {
                    lo = std::min(lo, texel({i, j, k}));
                    hi = std::max(hi, texel({i, j, k}));
                }
        constexpr double kMargin = 2.0 / 65535.0;
        return hi < m_shown.lo - kMargin || lo > m_shown.hi + kMargin;
    }

    int m_size;
    ValueRange m_shown;
    std::vector<double> m_texels;
    std::vector<std::vector<bool>> m_empty;
};

/// The cubes are at least as large as an octree's empty nodes allow from where a ray is, so that rays along
/// the axis leave large empty regions in fewer leaps, although each is one look-up instead of a descent.
TEST(Occupancy, CubesCoverTheEmptyNodesOfAnOctreeOnEveryLevel) {
    for (const double radius : {9.0, 17.3, 28.0}) {
        constexpr int kSize = 64;
        const auto volume = test::makeVolume({kSize, kSize, kSize}, [&](int i, int j, int k) {
            const glm::dvec3 apart = glm::dvec3(i, j, k) - glm::dvec3(30.0, 33.5, 31.0);
            return 30000.0 / (1.0 + std::exp(glm::length(apart) - radius));  // u from 0.5 to 0.96
        });
        const ValueRange shown{0.65, 0.75};
        const BruteForceOctree octree(*volume, shown);
        const BlockRanges ranges = blockRanges(*volume, 0, 1);
        const Occupancy found = occupancyOf(ranges, ShownQuanta(std::vector<ValueRange>{shown}), 0.0);
        const int blocks = kSize / kBlockEdge;
        const auto distance = [&](glm::ivec3 b) {
            return int{found.distance[static_cast<std::size_t>((b.z * blocks + b.y) * blocks + b.x)]};
        };
        for (int k = 0; k < kSize; ++k)
            for (int j = 0; j < kSize; ++j)
                for (int i = 0; i < kSize; ++i)
                    if (const double u = octree.texel({i, j, k}); u >= shown.lo && u <= shown.hi) {
                        ASSERT_EQ(distance(glm::ivec3(i, j, k) / kBlockEdge), 0);
                    }
        int emptyNodes = 0, leaps = 0, octreeLeaps = 0, octreeReads = 0;
        for (int z = 0; z < blocks; ++z)
            for (int y = 0; y < blocks; ++y) {
                for (int x = 0; x < blocks; ++x)
                    for (int level = 0; level < octree.levels(); ++level) {
                        const glm::ivec3 at(x, y, z);
                        if (!octree.isEmptyAt(level, at)) continue;
                        const glm::ivec3 inside(x & ((1 << level) - 1), y & ((1 << level) - 1),
                                                z & ((1 << level) - 1));
                        const glm::ivec3 near = glm::min(inside, (1 << level) - 1 - inside) + 1;
                        ASSERT_GE(distance(at), std::min({near.x, near.y, near.z})) << level;
                        ++emptyNodes;
                    }
                for (int x = 0; x < blocks; x += std::max(1, distance({x, y, z}))) ++leaps;
                for (int x = 0; x < blocks; ++octreeLeaps) {
                    int level = octree.levels() - 1;
                    while (level > 0 && !octree.isEmptyAt(level, {x, y, z})) --level;
                    octreeReads += octree.levels() - level;
                    x = ((x >> level) + 1) << level;
                }
            }
        EXPECT_GT(emptyNodes, 0);
        // Beside a surface cubes are small: more leaps, each of one read.
        EXPECT_LT(leaps, 1.25 * octreeLeaps) << radius;
        EXPECT_LT(2 * leaps, octreeReads) << radius;
    }
}

TEST(Occupancy, OvershootReachesBeyondTheRange) {
    BlockRanges ranges;
    ranges.blocks = {2, 1, 1};
    ranges.lo = {20000, 20000};
    ranges.hi = {30000, 20400};
    const std::vector<ValueRange> shown{{34000.0 / 65535.0, 0.6}};
    EXPECT_EQ(occupancyOf(ranges, ShownQuanta(shown), 0.0).occupied, 0u);
    // 0.4766 of 10000 beyond 30000.
    EXPECT_EQ(occupancyOf(ranges, ShownQuanta(shown), reachOf(Filter::CatmullRom).overshoot).occupied, 1u);
}

VolumeFacts unitFacts(VoxelType type) {
    return {axisAlignedGrid({64, 64, 64}), type, {0.0, 1.0}};
}

bool contains(const std::vector<ValueRange>& ranges, double value) {
    return std::any_of(ranges.begin(), ranges.end(),
                       [&](const ValueRange& range) { return range.lo <= value && value <= range.hi; });
}

/// Whatever the table says of a value, the value counts as shown when that is not 0; and little else does.
TEST(ShownValues, HoldEveryValueThatTheTableMakesVisible) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int hidden = 0;
    for (int turn = 0; turn < 60; ++turn) {
        Scene scene = test::rampScene(turn % 5 == 0 ? Mode::FirstHit : Mode::Composite);
        scene.hitOpacity = 0.02 + 0.9 * unit(random);
        scene.densityScale = turn % 2 == 0 ? 1.0 : 3.0;
        auto& points = scene.volumes[0].transferFunction->points;
        points.clear();
        double value = 1.4 * unit(random) - 0.5;
        for (auto n = 1 + random() % 7; n > 0; --n) {
            points.push_back({value, {1, 1, 1}, random() % 2 == 0 ? 0.0 : 2.0 * unit(random)});
            value += random() % 3 == 0 ? 0.0 : random() % 2 == 0 ? 1e-4 * unit(random) : 0.4 * unit(random);
        }
        const VolumeFacts facts = unitFacts(VoxelType::UInt8);
        const Plan plan = makePlan(scene, {facts}).value();
        const auto shown = shownValues(scene, plan, facts);
        for (std::size_t i = 1; i < shown.size(); ++i) EXPECT_GT(shown[i].lo, shown[i - 1].hi);
        const auto table =
            bakeTable(*scene.volumes[0].transferFunction, plan.table.lo, plan.table.hi, plan.table.size);
        const double least =
            scene.mode == Mode::FirstHit ? extinctionFromOpacity(scene.hitOpacity) / scene.densityScale : 0.0;
        for (int i = 0; i <= 20000; ++i) {
            const double v = i / 20000.0;
            const double extent = plan.table.hi - plan.table.lo;
            const double x = extent > 0.0 ? (v - plan.table.lo) / extent * (plan.table.size - 1) : 0.0;
            const double clamped = std::clamp(x, 0.0, plan.table.size - 1.0);
            const auto below = static_cast<std::size_t>(std::min(std::floor(clamped), plan.table.size - 2.0));
            const double f = clamped - static_cast<double>(below);
            const double extinction =
                (1.0 - f) * static_cast<double>(table[below].a) + f * static_cast<double>(table[below + 1].a);
            const bool visible = least > 0.0 ? extinction >= least : extinction > 0.0;
            if (visible) {
                EXPECT_TRUE(contains(shown, v)) << turn << ' ' << v;
            }
            hidden += contains(shown, v) ? 0 : 1;
        }
    }
    EXPECT_GT(hidden, 20000);
}

TEST(ShownValues, SurfacesAndExtremaHaveOneSide) {
    Scene scene = test::rampScene(Mode::Isosurface);
    VolumeFacts facts = unitFacts(VoxelType::UInt8);
    scene.volumes[0].isovalue = 0.5;
    scene.volumes[0].window = Window{0.5, 0.4};
    const auto shown = [&](Mode mode, bool descending) {
        scene.mode = mode;
        facts.descending = descending;
        return shownValues(scene, Plan{}, facts);
    };
    for (const bool descending : {false, true}) {
        EXPECT_EQ(contains(shown(Mode::Isosurface, descending), 0.4), descending);
        EXPECT_EQ(contains(shown(Mode::Isosurface, descending), 0.6), !descending);
        EXPECT_EQ(contains(shown(Mode::Mip, descending), 0.2), descending);
        EXPECT_EQ(contains(shown(Mode::Mip, descending), 0.8), !descending);
        EXPECT_EQ(contains(shown(Mode::MinIp, descending), 0.2), !descending);
        EXPECT_EQ(contains(shown(Mode::MinIp, descending), 0.8), descending);
        for (const Mode mode : {Mode::Isosurface, Mode::Mip, Mode::MinIp})
            EXPECT_TRUE(contains(shown(mode, descending), 0.5));
    }
}

}  // namespace
}  // namespace pellucid::renderer
