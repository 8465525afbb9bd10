// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/machine_info.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <fstream>
#include <thread>

namespace pellucid::accuracy {
namespace {

std::string cpuName() {
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with("model name")) continue;
        const std::size_t colon = line.find(": ");
        if (colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

std::string systemName() {
    utsname system{};
    if (uname(&system) != 0) return "unknown";
    return fmt::format("{} {} {}", system.sysname, system.release, system.machine);
}

}  // namespace

MachineInfo machineInfo(const renderer::Renderer::DeviceInfo& device) {
    MachineInfo info;
    info.cpu = cpuName();
    info.cores = static_cast<int>(std::thread::hardware_concurrency());
    info.system = systemName();
    info.driver = fmt::format("{}, {}, OpenGL {}", device.vendor, device.renderer, device.version);
    info.software = device.software;
    info.build =
        "Pellucid " PELLUCID_VERSION " " PELLUCID_REVISION ", " PELLUCID_COMPILER ", " PELLUCID_BUILD_TYPE;
    return info;
}

std::uint64_t stableHash(std::span<const std::byte> bytes, std::uint64_t seed) {
    std::uint64_t hash = seed;
    for (const std::byte byte : bytes) {
        hash ^= std::to_integer<std::uint64_t>(byte);
        hash *= 1099511628211ull;
    }
    return hash;
}

}  // namespace pellucid::accuracy
