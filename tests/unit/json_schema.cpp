// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/json_schema.h"

#include <regex.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace pellucid::test {

namespace {

using nlohmann::json;

bool hasType(const json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "number") return value.is_number();
    return type == "integer" &&
           (value.is_number_integer() ||
            (value.is_number_float() && std::floor(value.get<double>()) == value.get<double>()));
}

bool fitsPattern(const std::string& pattern, const std::string& text) {
    regex_t compiled;
    if (regcomp(&compiled, pattern.c_str(), REG_EXTENDED | REG_NOSUB) != 0) return false;
    const bool fits = regexec(&compiled, text.c_str(), 0, nullptr, 0) == 0;
    regfree(&compiled);
    return fits;
}

std::string objectFault(const json& root, const json& schema, const json& value, const std::string& pointer) {
    const json properties = schema.value("properties", json::object());
    for (const auto& [key, member] : value.items()) {
        if (properties.contains(key)) {
            const std::string fault = schemaFault(root, properties[key], member, pointer + "/" + key);
            if (!fault.empty()) return fault;
        } else if (!schema.value("additionalProperties", true)) {
            return fmt::format("{}: unknown member {}", pointer, key);
        }
    }
    for (const auto& required : schema.value("required", json::array()))
        if (!value.contains(required)) return fmt::format("{}: no member {}", pointer, required.dump());
    return {};
}

std::string arrayFault(const json& root, const json& schema, const json& value, const std::string& pointer) {
    if (value.size() < schema.value("minItems", std::size_t{0})) return pointer + ": too few items";
    if (schema.contains("maxItems") && value.size() > schema["maxItems"].get<std::size_t>())
        return pointer + ": too many items";
    for (std::size_t i = 0; schema.contains("items") && i < value.size(); ++i) {
        const std::string fault =
            schemaFault(root, schema["items"], value[i], fmt::format("{}/{}", pointer, i));
        if (!fault.empty()) return fault;
    }
    return {};
}

std::string numberFault(const json& schema, double value, const std::string& pointer) {
    const auto limit = [&](const char* key, auto fits) {
        return !schema.contains(key) || fits(value, schema[key].get<double>());
    };
    if (limit("minimum", std::greater_equal<>()) && limit("maximum", std::less_equal<>()) &&
        limit("exclusiveMinimum", std::greater<>()) && limit("exclusiveMaximum", std::less<>()))
        return {};
    return fmt::format("{}: {} is outside the limits", pointer, value);
}

std::string combinationFault(const json& root, const json& schema, const json& value,
                             const std::string& pointer) {
    if (schema.contains("oneOf")) {
        int fitting = 0;
        for (const json& option : schema["oneOf"])
            fitting += schemaFault(root, option, value, pointer).empty() ? 1 : 0;
        if (fitting != 1) return fmt::format("{}: fits {} of the options", pointer, fitting);
    }
    if (schema.contains("not") && schemaFault(root, schema["not"], value, pointer).empty())
        return pointer + ": fits what it must not";
    return {};
}

}  // namespace

const json& resolved(const json& root, const json& schema) {
    if (!schema.contains("$ref")) return schema;
    return root.at(json::json_pointer(schema["$ref"].get<std::string>().substr(1)));
}

std::string schemaFault(const json& root, const json& reference, const json& value,
                        const std::string& pointer) {
    static const std::set<std::string> kKnown{"$schema",
                                              "$ref",
                                              "title",
                                              "description",
                                              "definitions",
                                              "type",
                                              "properties",
                                              "required",
                                              "additionalProperties",
                                              "items",
                                              "minItems",
                                              "maxItems",
                                              "enum",
                                              "const",
                                              "pattern",
                                              "minimum",
                                              "maximum",
                                              "exclusiveMinimum",
                                              "exclusiveMaximum",
                                              "oneOf",
                                              "not"};
    for (const auto& [key, part] : reference.items())
        if (!kKnown.contains(key)) return "keyword that this validator does not know: " + key;
    const json& schema = resolved(root, reference);
    if (schema.contains("type") && !hasType(value, schema["type"]))
        return pointer + ": not of the type " + schema["type"].dump();
    if (schema.contains("const") && schema["const"] != value) return pointer + ": not the constant";
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
        return pointer + ": not in the list";
    if (schema.contains("pattern") && value.is_string() && !fitsPattern(schema["pattern"], value))
        return pointer + ": does not fit the pattern";
    std::string fault;
    if (value.is_object()) fault = objectFault(root, schema, value, pointer);
    if (value.is_array()) fault = arrayFault(root, schema, value, pointer);
    if (value.is_number()) fault = numberFault(schema, value.get<double>(), pointer);
    return fault.empty() ? combinationFault(root, schema, value, pointer) : fault;
}

}  // namespace pellucid::test
