// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_file.h"

#include "tests/io/load_expect.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string nrrd(const std::string& sizes, std::size_t bytes) {
    return "NRRD0004\ntype: uint8\ndimension: 3\nsizes: " + sizes + "\nspacings: 1 1 1\nencoding: raw\n\n" +
           std::string(bytes, '\7');
}

TEST(SceneFile, SourcesAreRelativeToTheFile) {
    const test::TempFolder folder;
    fs::create_directory(folder.path() / "data");
    folder.write("data/a.nrrd", nrrd("2 2 2", 8));
    folder.write("data/b.nrrd", nrrd("3 1 1", 3));
    const auto file = folder.write(
        "s.json",
        R"({"pellucid": 1, "volumes": [{"source": "data/a.nrrd"}, {"source": "data/b.nrrd"}, {"source": "data/a.nrrd"}]})");
    EXPECT_TRUE(looksLikeScene(file));
    const auto scene = loadScene(file);
    ASSERT_TRUE(scene) << scene.error().text();
    ASSERT_EQ(scene->volumes.size(), 3u);
    EXPECT_EQ(scene->volumes[0]->grid().size, glm::ivec3(2, 2, 2));
    EXPECT_EQ(scene->volumes[1]->grid().size, glm::ivec3(3, 1, 1));
    EXPECT_EQ(scene->volumes[2], scene->volumes[0]);  // one source is read once
    EXPECT_EQ(fs::path(scene->scene.volumes[0].source), fs::canonical(folder.path()) / "data/a.nrrd");
}

TEST(SceneFile, SavedScenesAreFoundAgainFromAnotherFolder) {
    const test::TempFolder folder;
    fs::create_directories(folder.path() / "data");
    fs::create_directories(folder.path() / "scenes/deep");
    const auto data = folder.write("data/a.nrrd", nrrd("2 2 2", 8));
    const auto opened = open({data});
    ASSERT_TRUE(opened) << opened.error().text();
    ASSERT_EQ(opened->scene.volumes.size(), 1u);
    EXPECT_EQ(opened->scene.volumes[0].name, "a.nrrd");
    const auto file = folder.path() / "scenes/deep/s.json";
    ASSERT_TRUE(saveScene(file, opened->scene));
    EXPECT_THAT(test::readBytes(file), HasSubstr("\"../../data/a.nrrd\""));
    fs::rename(folder.path(), folder.path().string() + "-moved");
    const auto again = open({folder.path().string() + "-moved/scenes/deep/s.json"});
    EXPECT_TRUE(again) << again.error().text();
    fs::rename(folder.path().string() + "-moved", folder.path());
    EXPECT_EQ(loadScene(file)->scene, opened->scene);
}

TEST(SceneFile, ErrorsNameTheFileAndThePointer) {
    const test::TempFolder folder;
    folder.write("a.nrrd", nrrd("2 2 2", 7));
    folder.write("b.nrrd", nrrd("2 2 2", 8));
    const auto refused = [&](const std::string& text) {
        const auto scene = loadScene(folder.write("s.json", text));
        EXPECT_FALSE(scene);
        return scene ? std::string{} : scene.error().text();
    };
    EXPECT_THAT(refused(R"({"pellucid": 1, "volumes": [{"source": "a.nrrd"}]})"),
                testing::AllOf(HasSubstr("s.json"), HasSubstr("/volumes/0/source"), HasSubstr("a.nrrd"),
                               HasSubstr("found 7 bytes")));
    EXPECT_THAT(refused(R"({"pellucid": 1, "volumes": [{"source": "gone.nrrd"}]})"),
                HasSubstr("gone.nrrd does not exist"));
    EXPECT_THAT(refused(R"({"pellucid": 1, "volumes": [{"name": "x"}]})"), HasSubstr("/volumes/0/source"));
    EXPECT_THAT(refused(R"({"pellucid": 1, "volumes": [{"source": "b.nrrd", "component": 1}]})"),
                HasSubstr("/volumes/0/component: found 1"));
    EXPECT_THAT(refused(R"({"pellucid": 1, "volumes": [{"source": "b.nrrd" "component": 1}]})"),
                HasSubstr("s.json"));
    EXPECT_FALSE(open({}));
}

TEST(SceneFile, ProgressRunsOnOverAllVolumesAndCancels) {
    const test::TempFolder folder;
    folder.write("a.nrrd", nrrd("2 2 2", 8));
    folder.write("b.nrrd", nrrd("2 2 2", 8));
    const auto file =
        folder.write("s.json", R"({"pellucid": 1, "volumes": [{"source": "a.nrrd"}, {"source": "b.nrrd"}]})");
    std::vector<double> seen;
    LoadOptions options;
    options.progress = [&](double fraction, std::string_view) {
        seen.push_back(fraction);
        return true;
    };
    ASSERT_TRUE(loadScene(file, options));
    ASSERT_GE(seen.size(), 2u);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_EQ(seen.front(), 0.0);
    EXPECT_GE(seen.back(), 0.5);
    EXPECT_LE(seen.back(), 1.0);
    options.progress = [](double fraction, std::string_view) { return fraction < 0.5; };
    const auto cancelled = loadScene(file, options);
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(static_cast<int>(cancelled.error().code), static_cast<int>(ErrorCode::Cancelled));
}

TEST(SceneFile, OtherFilesAreNoScenes) {
    const test::TempFolder folder;
    EXPECT_FALSE(looksLikeScene(folder.write("a.json", R"({"size": [1, 2, 3]})")));
    EXPECT_FALSE(looksLikeScene(folder.write("a.nrrd", nrrd("1 1 1", 1))));
    EXPECT_FALSE(looksLikeScene(folder.path()));
    EXPECT_FALSE(looksLikeScene(folder.path() / "gone"));
}

}  // namespace
}  // namespace pellucid::io
