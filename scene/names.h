// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

namespace pellucid {

enum class Accumulation;
enum class AnatomicalView;
enum class Classification;
enum class CompositingSpace;
enum class ErrorNorm;
enum class Filter;
enum class Gradients;
enum class Integrator;
enum class LightKind;
enum class Mode;
enum class Projection;
enum class XRayDisplay;

/// An enumerator and its name in the JSON form and on the command line: "first-hit", "catmull-rom".
template <class E>
struct EnumName {
    E value;
    const char* name;
};

/// Every enumerator of E in the order of its declaration; this is the one place where their names are
/// written. Defined for the enumerations above.
template <class E>
[[nodiscard]] std::span<const EnumName<E>> enumNames();

template <class E>
requires std::is_enum_v<E>
[[nodiscard]] const char* name(E value) {
    for (const auto& entry : enumNames<E>())
        if (entry.value == value) return entry.name;
    return "";
}

template <class E>
[[nodiscard]] std::optional<E> enumFromName(std::string_view text) {
    for (const auto& entry : enumNames<E>())
        if (entry.name == text) return entry.value;
    return std::nullopt;
}

template <>
std::span<const EnumName<Accumulation>> enumNames<Accumulation>();
template <>
std::span<const EnumName<AnatomicalView>> enumNames<AnatomicalView>();
template <>
std::span<const EnumName<Classification>> enumNames<Classification>();
template <>
std::span<const EnumName<CompositingSpace>> enumNames<CompositingSpace>();
template <>
std::span<const EnumName<ErrorNorm>> enumNames<ErrorNorm>();
template <>
std::span<const EnumName<Filter>> enumNames<Filter>();
template <>
std::span<const EnumName<Gradients>> enumNames<Gradients>();
template <>
std::span<const EnumName<Integrator>> enumNames<Integrator>();
template <>
std::span<const EnumName<LightKind>> enumNames<LightKind>();
template <>
std::span<const EnumName<Mode>> enumNames<Mode>();
template <>
std::span<const EnumName<Projection>> enumNames<Projection>();
template <>
std::span<const EnumName<XRayDisplay>> enumNames<XRayDisplay>();

}  // namespace pellucid
