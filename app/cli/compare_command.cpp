// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "accuracy/metrics.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "io/image_file.h"

namespace pellucid::app {

namespace {

struct CompareArguments {
    std::string a, b;
    std::optional<double> maxGreyLevels, rmseGreyLevels, minSsim;
};

/// Prints one metric with its limit; true when it is within. Written so that NaN is beyond every limit.
bool printMetric(const char* name, double value, const char* unit, std::optional<double> limit,
                 bool atLeast) {
    const bool within = !limit || (atLeast ? value >= *limit : value <= *limit);
    const std::string verdict =
        limit ? fmt::format(" ({} {} {:g})", within ? "ok" : "BEYOND", atLeast ? ">=" : "<=", *limit) : "";
    fmt::print("{:<5} {:.6g}{}{}\n", name, value, unit, verdict);
    return within;
}

int run(const CompareArguments& arguments) {
    const Result<ImageF> a = io::readImage(arguments.a);
    if (!a) return report(a.error());
    const Result<ImageF> b = io::readImage(arguments.b);
    if (!b) return report(b.error());
    const Result<accuracy::ImageDifference> difference = accuracy::difference(*a, *b);
    if (!difference) return report(difference.error());

    const std::string worst =
        fmt::format(" grey levels, at pixel {}, {}", difference->worstPixel.x, difference->worstPixel.y);
    bool within =
        printMetric("max", 255.0 * difference->maxError, worst.c_str(), arguments.maxGreyLevels, false);
    within &= printMetric("rmse", 255.0 * difference->rmse, " grey levels", arguments.rmseGreyLevels, false);
    printMetric("mean", 255.0 * difference->meanError, " grey levels", std::nullopt, false);
    printMetric("psnr", difference->psnr, " dB", std::nullopt, true);
    within &= printMetric("ssim", difference->ssim, "", arguments.minSsim, true);
    const bool numbers = difference->maxError >= 0.0;  // false for NaN: such pictures are never alike
    return within && numbers ? kExitOk : kExitBeyond;
}

}  // namespace

Command addCompareCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("compare", "Measures how far two pictures are apart");
    const auto arguments = std::make_shared<CompareArguments>();
    command->add_option("a", arguments->a, "A picture: .png, .npy or .pfm")->type_name("A")->required();
    command->add_option("b", arguments->b, "The other, of the same size")->type_name("B")->required();
    command->add_option("--max", arguments->maxGreyLevels,
                        "Largest difference allowed, in grey levels (1/255)");
    command->add_option("--rmse", arguments->rmseGreyLevels,
                        "Largest root mean square allowed, in grey levels");
    command->add_option("--ssim", arguments->minSsim, "Smallest structural similarity allowed, up to 1");
    command->footer(
        "Prints the differences over RGB in grey levels (1/255 of the full range), PSNR and SSIM. Exit "
        "status 0 within\n"
        "the limits given, 1 beyond one of them or where a picture holds NaN, 2 where they cannot be "
        "compared.\n\n"
        "Examples:\n"
        "  pellucid compare a.png b.png\n"
        "  pellucid compare fast.npy exact.npy --max 1 --rmse 0.1 --ssim 0.999");
    return {command, [arguments] { return run(*arguments); }};
}

}  // namespace pellucid::app
