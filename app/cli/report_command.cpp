// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "accuracy/report_html.h"
#include "accuracy/report_json.h"
#include "accuracy/report_plan.h"
#include "accuracy/report_run.h"
#include "app/cli/arguments.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "io/atomic_file.h"
#include "io/image_file.h"

namespace pellucid::app {

namespace fs = std::filesystem;

namespace {

struct ReportArguments {
    InputArguments input;
    LookArguments look;
    std::string folder;
    bool quick = false;
    bool peers = false;
    std::optional<double> budgetMinutes;
};

Result<void> writeText(const fs::path& file, const std::string& text) {
    return io::writeFile(file, std::as_bytes(std::span(text)));
}

std::optional<std::string> readBytes(const fs::path& file) {
    const auto bytes = io::readFile(file);
    if (!bytes) return std::nullopt;
    return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

Result<void> writeReport(const fs::path& folder, const accuracy::ReportData& data, const Scene& scene) {
    const accuracy::ReportAnalysis analysis = accuracy::analyse(data, scene);
    const auto readPicture = [&](const std::string& name) { return readBytes(folder / "pictures" / name); };
    auto written = writeText(folder / "report.json", accuracy::reportJson(data, analysis).dump(1) + "\n");
    if (written) written = writeText(folder / "report.csv", accuracy::reportCsv(data, analysis));
    if (written)
        written = writeText(folder / "index.html", accuracy::reportHtml(data, analysis, readPicture));
    return written;
}

/// A name for people: that of the volume, which scanners leave at "None" at times, and of the file.
std::string nameOf(const InputArguments& input, const Volume& volume) {
    fs::path path = fs::path(input.paths.front()).lexically_normal();
    if (path.filename().empty()) path = path.parent_path();
    const std::string file = path.filename().string();
    return volume.info().name.empty() ? file : fmt::format("{} ({})", volume.info().name, file);
}

void printSummary(const fs::path& folder, const accuracy::ReportData& data) {
    clearProgress();
    for (const std::string& note : data.notes) fmt::print(stderr, "pellucid: {}\n", note);
    fmt::print("{}: {} of {} settings", (folder / "index.html").string(), data.measurements.size(),
               data.planned);
    if (!data.leftOut.empty())
        fmt::print(", the others left out, first {}: {}", settingName(data.leftOut.front().setting),
                   data.leftOut.front().why);
    fmt::print("\n");
}

int run(const ReportArguments& arguments) {
    const Result<io::LoadedScene> loaded = openInput(arguments.input, arguments.look);
    if (!loaded) return report(loaded.error());
    if (loaded->volumes.size() != 1)
        return report(Error{ErrorCode::Unsupported, "a report is made of scenes with one volume", {}});
    accuracy::ReportJob job;
    job.scene = completed(loaded->scene, loaded->volumes);
    job.volume = loaded->volumes.front();
    job.name = nameOf(arguments.input, *job.volume);
    job.scope = arguments.quick ? accuracy::quickScope(job.scene) : accuracy::fullScope(job.scene);
    job.scope.peers = arguments.peers;
    if (arguments.budgetMinutes) job.scope.budgetSeconds = 60.0 * *arguments.budgetMinutes;
    job.folder = arguments.folder;
    job.files = {io::writePng, io::writePfm, io::readPfm};
    job.progress = consoleProgress();

    Result<renderer::Renderer> renderer = renderer::Renderer::headless();
    if (!renderer) return report(renderer.error());
    const auto data = accuracy::measureReport(job, *renderer);
    if (!data) {
        const int status = report(data.error());
        if (data.error().code == ErrorCode::Cancelled)
            fmt::print(stderr,
                       "pellucid: what was measured is kept in {}; the same command goes on from there\n",
                       arguments.folder);
        return status;
    }
    if (auto written = writeReport(job.folder, *data, job.scene); !written) return report(written.error());
    printSummary(job.folder, *data);
    return kExitOk;
}

}  // namespace

Command addReportCommand(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("report", "Measures error against run time, and writes a page of plots");
    const auto arguments = std::make_shared<ReportArguments>();
    arguments->folder = "pellucid-report";
    addInputOptions(*command, arguments->input);
    addLookOptions(*command, arguments->look);
    command->add_option("-o,--output", arguments->folder, "Folder for the report (pellucid-report)")
        ->type_name("DIR");
    command->add_flag("--quick", arguments->quick,
                      "Under a minute: a small picture, few steps; says what it left out");
    command
        ->add_option(
            "--budget", arguments->budgetMinutes,
            "Begins nothing that is not expected to end within these minutes; the same command again "
            "goes on")
        ->type_name("MINUTES")
        ->check(CLI::PositiveNumber);
    command->add_flag("--peers", arguments->peers,
                      "Measures VTK's volume renderers too, where there is an X display");
    command->footer(
        "Draws the scene with every integrator, step, filter and accumulation format and compares each "
        "picture "
        "with a\n"
        "reference in double precision. Writes index.html (needs nothing else), report.json and report.csv. "
        "Each finished\n"
        "measurement is kept in the folder: after Ctrl-C the same command goes on. Left out, and said so, "
        "are "
        "settings of\n"
        "which a frame would take more than 10 s, and filters whose reference would take more than 15 min. "
        "Without --quick\n"
        "it takes long: minutes on a graphics card, hours on a software driver.\n\n"
        "Examples:\n"
        "  pellucid report ct-head/ -o head-report --quick\n"
        "  pellucid report scene.json -o scene-report --size 256x256 --peers");
    return {command, [arguments] { return run(*arguments); }};
}

}  // namespace pellucid::app
