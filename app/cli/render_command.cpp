// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/picture.h"

namespace pellucid::app {

namespace {

struct RenderArguments {
    PictureJob job;
    std::string output;
    bool alsoFloat = false;
    bool noError = false;
};

int run(const RenderArguments& arguments) {
    PictureJob job = arguments.job;
    const std::filesystem::path output = arguments.output;
    if (!isPictureName(output)) {
        return reportUsage(
            "-o takes a name that ends in .png, .npy or .pfm; found '" + arguments.output + "'", "render");
    }
    job.outputs = {output};
    if (arguments.alsoFloat && output.extension() == ".png") {
        job.outputs.push_back(std::filesystem::path(output).replace_extension(".npy"));
    }
    job.estimateError = !arguments.noError;
    return makePicture(job);
}

}  // namespace

Command addRenderCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("render", "Draws a scene or a scan to a picture");
    const auto arguments = std::make_shared<RenderArguments>();
    addInputOptions(*command, arguments->job.input);
    addLookOptions(*command, arguments->job.look);
    command
        ->add_option(
            "-o,--output", arguments->output,
            "The picture: .png (8 bits), .npy (float RGBA) or .pfm (float RGB), floats before quantisation")
        ->type_name("FILE")
        ->required();
    command->add_flag("--float", arguments->alsoFloat, "Beside a .png, write the float picture as .npy too");
    command->add_flag("--no-error", arguments->noError,
                      "Leave out the error estimate, which costs once to twice the time of the picture");
    command->footer(
        "Prints the picture's size, the time to draw it, and how wrong it is: the difference to the picture "
        "of a quarter of the\n"
        "step, in grey levels (1/255). The same scene gives the same bytes on the same machine.\n\n"
        "Examples:\n"
        "  pellucid render ct-head/ -o head.png\n"
        "  pellucid render ct-head/ -o head.png --size 1024x768 --view left --preset \"CT bone\"\n"
        "  pellucid render scene.json -o exact.npy --set quality.stepVoxels=0.125 --set "
        "quality.earlyTermination=0\n"
        "  pellucid render mr.nii.gz -o vessels.png --mode mip --set camera.projection=orthographic\n"
        "  pellucid render ct.raw -o ct.png --raw-size 64x64x93 --raw-type int16 --raw-spacing 3.2x3.2x1.5");
    return {command, [arguments] { return run(*arguments); }};
}

}  // namespace pellucid::app
