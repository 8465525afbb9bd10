// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <map>
#include <memory>

#include "app/cli/arguments.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "io/nrrd_write.h"
#include "scene/resample.h"

namespace pellucid::app {

namespace {

struct ResampleArguments {
    InputArguments input;
    std::string output;
    ResampleOptions options;
};

int run(const ResampleArguments& arguments) {
    const std::filesystem::path output = arguments.output;
    if (output.extension() != ".nrrd")
        return reportUsage("-o takes a name that ends in .nrrd; found '" + arguments.output + "'",
                           "resample");
    const Result<io::LoadedScene> loaded = openInput(arguments.input, {});
    if (!loaded) return report(loaded.error());
    ResampleOptions options = arguments.options;
    options.progress = consoleProgress();
    const Result<VolumePtr> made = resampled(*loaded->volumes.front(), options);
    clearProgress();
    if (!made) return report(made.error());
    if (const auto written = io::writeNrrd(output, **made); !written) return report(written.error());
    const Grid& grid = (*made)->grid();
    const glm::dvec3 spacing = spacingMm(grid);
    fmt::print("{}: {} x {} x {} voxels of {:.4g} x {:.4g} x {:.4g} mm\n", arguments.output, grid.size.x,
               grid.size.y, grid.size.z, spacing.x, spacing.y, spacing.z);
    return kExitOk;
}

}  // namespace

Command addResampleCommand(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("resample", "Writes a volume on a finer or coarser grid as .nrrd");
    const auto arguments = std::make_shared<ResampleArguments>();
    addInputOptions(*command, arguments->input);
    command->add_option("-o,--output", arguments->output, "The new volume, .nrrd, float32")
        ->type_name("FILE")
        ->required();
    command->add_option("--factor", arguments->options.factor,
                        "New samples per old one along each axis (default 2)");
    static const std::map<std::string, ResampleMethod> methods{{"sinc", ResampleMethod::Sinc},
                                                               {"gaussian", ResampleMethod::Gaussian},
                                                               {"fourier", ResampleMethod::Fourier}};
    command
        ->add_option("--method", arguments->options.method,
                     "sinc (default): sharp; gaussian: smooth, no overshoot; fourier: the ideal sinc, "
                     "whole factors")
        ->transform(CLI::CheckedTransformer(methods))
        ->type_name("METHOD");
    command->footer(
        "Voxel 0 0 0 stays where it is. Below 1 the kernel is a low-pass that removes what the coarser grid "
        "would alias.\n\n"
        "Examples:\n"
        "  pellucid resample ct-head/ -o finer.nrrd --factor 2 --method fourier\n"
        "  pellucid resample brain.nii.gz -o coarser.nrrd --factor 0.5");
    return {command, [arguments] { return run(*arguments); }};
}

}  // namespace pellucid::app
