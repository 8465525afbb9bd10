// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/lint/rules.h"

#include <gmock/gmock.h>

// Proves of each rule that it fails on a bad sample and lets a good one pass.
namespace pellucid::lint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kHead =
    "// SPDX-FileCopyrightText: Pellucid contributors\n// SPDX-License-Identifier: BSD-3-Clause\n";

TEST(LintIncludes, RefusesEveryArrowThatPointsUpOrSideways) {
    const std::vector<std::pair<std::string, std::string>> wrong = {
        {"scene/a.cpp", "io/load.h"},
        {"scene/a.cpp", "app/cli/cli.h"},
        {"io/a.h", "renderer/renderer.h"},
        {"renderer/a.cpp", "io/load.h"},
        {"renderer/a.cpp", "accuracy/metrics.h"},
        {"tfeditor/a.cpp", "renderer/frame.h"},
        {"segmentation/a.h", "io/load.h"},
        {"accuracy/a.cpp", "io/load.h"},
        {"io/a.cpp", "segmentation/x.h"},
        {"renderer/plan/a.cpp", "renderer/gpu/buffer.h"},
        {"app/cli/a.cpp", "app/desktop/desktop.h"},
        {"scene/a.cpp", "tests/support/x.h"},
    };
    for (const auto& [file, header] : wrong) {
        EXPECT_THAT(checkIncludes({file, "#include <vector>\n#include \"" + header + "\"\n"}),
                    ElementsAre(HasSubstr(file + ":2: includes \"" + header)))
            << file << " -> " << header;
    }
}

TEST(LintIncludes, AllowsTheArrowsOfTheDesign) {
    const std::vector<std::pair<std::string, std::string>> right = {
        {"io/a.cpp", "scene/volume.h"},
        {"accuracy/a.cpp", "renderer/renderer.h"},
        {"app/cli/a.cpp", "io/load.h"},
        {"app/desktop/a.cpp", "tfeditor/w.h"},
        {"tests/gl/a.cpp", "renderer/gpu/buffer.h"},
        {"renderer/passes/a.cpp", "renderer/gpu/buffer.h"},
    };
    for (const auto& [file, header] : right) {
        EXPECT_THAT(checkIncludes({file, "  #  include \"" + header + "\"  // why\n"}), IsEmpty())
            << file << " -> " << header;
    }
}

TEST(LintIncludes, KeepsLibrariesInTheirRooms) {
    const std::vector<std::pair<std::string, std::string>> wrong = {
        {"scene/a.cpp", "QString"},
        {"renderer/a.cpp", "QOpenGLWidget"},
        {"app/cli/a.cpp", "QtWidgets/QLabel"},
        {"app/desktop/a.cpp", "epoxy/gl.h"},
        {"accuracy/a.cpp", "GL/gl.h"},
        {"renderer/plan/a.cpp", "epoxy/gl.h"},
        {"renderer/gpu/a.cpp", "vtkNew.h"},
        {"app/cli/a.cpp", "vtkImageData.h"},
        {"accuracy/a.cpp", "dcmtk/dcmdata/dctk.h"},
        {"io/a.cpp", "CLI/CLI.hpp"},
        {"tests/unit/a.cpp", "dcmtk/config/osconfig.h"},
    };
    for (const auto& [file, header] : wrong) {
        EXPECT_THAT(checkIncludes({file, "#include <" + header + ">\n"}),
                    ElementsAre(HasSubstr("is not for this room")))
            << file << " -> " << header;
    }
    EXPECT_THAT(checkIncludes({"io/a.cpp", "#include <vtkNew.h>\n#include <dcmtk/dcmdata/dctk.h>\n"}),
                IsEmpty());
    EXPECT_THAT(checkIncludes({"app/desktop/a.cpp", "#include <QWidget>\n"}), IsEmpty());
    EXPECT_THAT(checkIncludes({"renderer/gpu/a.h", "#include <epoxy/gl.h>\n"}), IsEmpty());
}

TEST(LintIncludes, AsksForTheRoomInTheName) {
    EXPECT_THAT(checkIncludes({"scene/a.cpp", "#include \"grid.h\"\n"}),
                ElementsAre(HasSubstr("by their room")));
    EXPECT_THAT(checkIncludes({"somewhere/a.cpp", ""}), ElementsAre(HasSubstr("no room")));
}

TEST(LintIncludes, IgnoresCommentsAndStrings) {
    EXPECT_THAT(checkIncludes({"scene/a.cpp",
                               "// #include <QString>\n/*\n#include <QString>\n*/\n"
                               "const char* s = \"#include <QString>\";\n"}),
                IsEmpty());
}

TEST(LintPrivateHeaders, RefusesALibraryThatLeaksOutOfItsRoom) {
    const SourceFile header{"io/vtk_convert.h", "#include <vtkImageData.h>\n"};
    EXPECT_THAT(checkPrivateHeaders({header, {"app/cli/a.cpp", "#include \"io/vtk_convert.h\"\n"}}),
                ElementsAre(HasSubstr("private to its room because it includes VTK")));
    EXPECT_THAT(checkPrivateHeaders({header, {"io/a.cpp", "#include \"io/vtk_convert.h\"\n"}}), IsEmpty());
}

TEST(LintCalls, RefusesBannedCallsEverywhere) {
    for (const std::string call :
         {"atof(s)", "std::stod(s)", "sscanf(s, f, &x)", "rand()", "std::exit(1)", "::exit(1)"}) {
        EXPECT_THAT(checkCalls({"app/a.cpp", "void f() {\n    " + call + ";\n}\n"}),
                    ElementsAre(HasSubstr("app/a.cpp:2:")))
            << call;
    }
}

TEST(LintCalls, LetsMembersOtherNamesCommentsAndStringsPass) {
    const char* fine =
        "app.exit(e); this->exit(1); QCoreApplication::exit(0); grand(1); operand(2); int exitStatus = 0; // "
        "exit(1)\n"
        "say(\"never exit(1)\"); auto big = 1'000'000; char q = '\\''; const char* r = R\"x(rand() \" "
        "exit(0))x\"; /* rand() */\n";
    EXPECT_THAT(checkCalls({"scene/a.cpp", fine}), IsEmpty());
    EXPECT_THAT(checkCalls({"scene/a.cpp", "char q = '\"'; exit(1); char p = '\"';"}),
                ElementsAre(HasSubstr("exit")));
}

TEST(LintCalls, RefusesPrintingInLibrariesOnly) {
    const char* prints =
        "void f() { std::cout << 1; }\nvoid g() { fmt::print(\"x\"); std::printf(\"x\"); }\n";
    EXPECT_THAT(checkCalls({"io/a.cpp", prints}),
                ElementsAre(HasSubstr("io/a.cpp:1: std::cout"), HasSubstr("io/a.cpp:2: printf"),
                            HasSubstr("fmt::print")));
    EXPECT_THAT(checkCalls({"app/cli/a.cpp", prints}), IsEmpty());
    EXPECT_THAT(checkCalls({"tests/unit/a.cpp", prints}), IsEmpty());
}

TEST(LintAscii, RefusesOtherBytes) {
    EXPECT_THAT(checkAscii({"scene/a.cpp", "// a\n// \xC2\xB5m\n"}),
                ElementsAre(HasSubstr("scene/a.cpp:2: is not ASCII")));
    EXPECT_THAT(checkAscii({"scene/a.cpp", "// um\n"}), IsEmpty());
}

TEST(LintLength, Refuses451Lines) {
    EXPECT_THAT(checkLength({"scene/a.cpp", std::string(451, '\n')}), ElementsAre(HasSubstr("451 lines")));
    EXPECT_THAT(checkLength({"scene/a.cpp", std::string(450, '\n')}), IsEmpty());
}

TEST(LintHead, AsksForTheLicenceAndPragmaOnce) {
    EXPECT_THAT(checkHead({"scene/a.cpp", "#include <vector>\n"}), ElementsAre(HasSubstr("SPDX")));
    EXPECT_THAT(checkHead({"scene/a.h", kHead}), ElementsAre(HasSubstr("#pragma once")));
    EXPECT_THAT(checkHead({"scene/a.h", std::string(kHead) + "// #pragma once\n"}),
                ElementsAre(HasSubstr("#pragma once")));
    EXPECT_THAT(checkHead({"scene/a.h", std::string(kHead) + "#pragma once\n"}), IsEmpty());
    EXPECT_THAT(checkHead({"scene/a.cpp", kHead}), IsEmpty());
}

TEST(LintLinks, RefusesALinkToNothing) {
    const auto exists = [](const std::string& path) { return path == "docs/there.md"; };
    const SourceFile page{"docs/a.md",
                          "[a](there.md#part)\n[b](gone.md) [c](https://example.org/x) [d](#here)\n"};
    EXPECT_THAT(checkLinks(page, exists), ElementsAre(HasSubstr("docs/a.md:2: links to 'gone.md'")));
}

TEST(LintTechniques, RefusesNamesOfNothing) {
    const auto exists = [](const std::string& path) { return path == "a/b.cpp"; };
    const auto hasTest = [](const std::string& name) { return name == "Suite.Right"; };
    const std::string head = "| ID | technique | files | tests |\n|---|---|---|---|\n";
    const auto check = [&](const std::string& row) {
        return checkTechniques({"docs/t.md", head + row}, exists, hasTest);
    };
    EXPECT_THAT(check("| B1.4g | *Over*: `\"mode\"` | `a/b.cpp` | `Suite.Right` |\n"), IsEmpty());
    EXPECT_THAT(check("| B1.4g | x | `a/c.cpp` | `Suite.Right` |\n"),
                ElementsAre(HasSubstr("docs/t.md:3: B1.4g names the file 'a/c.cpp'")));
    EXPECT_THAT(check("| B1.4g | x | `a/b.cpp` | `Suite.Right` `Suite.Gone` |\n"),
                ElementsAre(HasSubstr("the test 'Suite.Gone'")));
    EXPECT_THAT(check("| B1.4g | x | `a/b.cpp` | |\n"), ElementsAre(HasSubstr("names no file or no test")));
}

TEST(LintTechniques, FindsTheTestsOfAFile) {
    EXPECT_THAT(testsIn("TEST(A, B) {}\nTEST_F(C,\n       D) {}\n// TEST(E, F)\nTEST_P(G, H) {}"),
                ElementsAre("A.B", "C.D", "G.H"));
}

}  // namespace
}  // namespace pellucid::lint
