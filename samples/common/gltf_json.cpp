// SPDX-License-Identifier: MIT
#include "gltf_json.h"

#include "gltf_refusal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace forelock::samples {
namespace {

using nlohmann::json;

// A scene nests at most 8 deep; extras of other programs a little more.
constexpr size_t kDeepest = 64;
// Doubles hold whole numbers up to here, so that no JSON writer means more.
constexpr uint64_t kLargestNumber = uint64_t{1} << 53;
constexpr uint64_t kLargestInt = 0x7fffffff;

// Parsers of JSON and what they feed call themselves for each level.
void checkNesting(std::string_view text) {
  size_t depth = 0;
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      else if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest)
        refuseGltf("GLTF_NESTING", "its JSON nests deeper than " + std::to_string(kDeepest) + " levels (byte " + std::to_string(i) +
                                       " of the JSON): it is damaged or made to do harm");
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
  }
}

std::string shown(const json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array";
  return printable(value.dump(), 40);
}

[[noreturn]] void wrongField(const std::string& where, const json& value, const std::string& wanted) {
  refuseGltf("GLTF_FIELD", where + " is " + shown(value) + ": it has to be " + wanted + "; export the file again");
}

class Checker {
public:
  explicit Checker(const json& root) : root_(root) {}
  CheckedGltf run();

private:
  enum class Need { optional, required };

  const json* find(const json& in, const std::string& where, const char* name, Need need) const {
    const auto found = in.find(name);
    if (found != in.end()) return &*found;
    if (need == Need::required) refuseGltf("GLTF_FIELD", where + "." + name + " is missing; export the file again");
    return nullptr;
  }

  static uint64_t whole(const json& value, const std::string& where, uint64_t least, uint64_t most) {
    std::optional<uint64_t> number;
    if (value.is_number_unsigned()) number = value.get<uint64_t>();
    else if (value.is_number_float()) {  // 1e12 and 12.0 are whole numbers too
      const double real = value.get<double>();
      if (real >= 0 && real <= double(kLargestNumber) && real == std::floor(real)) number = uint64_t(real);
    }
    if (!number || *number < least || *number > most)
      wrongField(where, value, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return *number;
  }

  std::optional<uint64_t> number(const json& in, json& out, const std::string& where, const char* name, Need need, uint64_t least, uint64_t most) const {
    const json* value = find(in, where, name, need);
    if (!value) return {};
    const uint64_t checked = whole(*value, where + "." + name, least, most);
    out[name] = checked;
    return checked;
  }

  uint64_t indexInto(const char* section, const json& value, const std::string& where) const {
    const auto found = root_.find(section);
    const size_t size = found != root_.end() && found->is_array() ? found->size() : 0;
    const uint64_t index = whole(value, where, 0, kLargestNumber);
    if (index >= size)
      refuseGltf("GLTF_REFERENCE", where + " is " + std::to_string(index) + ", but there are " + std::to_string(size) + " " + section +
                                       ": the file is damaged, export it again");
    return index;
  }

  void reference(const json& in, json& out, const std::string& where, const char* name, const char* section, Need need = Need::optional) const {
    if (const json* value = find(in, where, name, need)) out[name] = indexInto(section, *value, where + "." + name);
  }

  void references(const json& in, json& out, const std::string& where, const char* name, const char* section) const {
    const json* value = find(in, where, name, Need::optional);
    if (!value) return;
    if (!value->is_array()) wrongField(where + "." + name, *value, "an array");
    json& checked = out[name] = json::array();
    for (size_t i = 0; i < value->size(); ++i)
      checked.push_back(indexInto(section, (*value)[i], where + "." + name + "[" + std::to_string(i) + "]"));
  }

  void numbers(const json& in, json& out, const std::string& where, const char* name, size_t count) const {
    const json* value = find(in, where, name, Need::optional);
    if (!value) return;
    const bool right = value->is_array() && value->size() == count && std::all_of(value->begin(), value->end(), [](const json& n) { return n.is_number(); });
    if (!right) wrongField(where + "." + name, *value, std::to_string(count) + " numbers");
    out[name] = *value;
  }

  void text(const json& in, json& out, const std::string& where, const char* name, Need need = Need::optional) const {
    const json* value = find(in, where, name, need);
    if (!value) return;
    if (!value->is_string()) wrongField(where + "." + name, *value, "a text");
    out[name] = *value;
  }

  json accessor(const json& in, const std::string& where) const;
  json bufferView(const json& in, const std::string& where) const;
  json buffer(const json& in, const std::string& where);
  json primitive(const json& in, const std::string& where);
  json mesh(const json& in, const std::string& where);
  json node(const json& in, const std::string& where);
  json scene(const json& in, const std::string& where) const;

  template <class Function> void section(const char* name, Function&& check) {
    const json* array = find(root_, "the file", name, Need::optional);
    if (!array) return;
    if (!array->is_array()) wrongField(name, *array, "an array");
    json& checked = result_.document[name] = json::array();
    for (size_t i = 0; i < array->size(); ++i) {
      const std::string where = std::string(name) + "[" + std::to_string(i) + "]";
      if (!(*array)[i].is_object()) wrongField(where, (*array)[i], "an object");
      checked.push_back(check((*array)[i], where));
    }
  }

  void extensionNames(const char* name) {
    const json* array = find(root_, "the file", name, Need::optional);
    if (!array) return;
    const bool right = array->is_array() && std::all_of(array->begin(), array->end(), [](const json& n) { return n.is_string(); });
    if (!right) wrongField(name, *array, "an array of texts");
    result_.document[name] = *array;
  }

  const json& root_;
  CheckedGltf result_;
};

json Checker::accessor(const json& in, const std::string& where) const {
  json out = json::object();
  reference(in, out, where, "bufferView", "bufferViews");
  number(in, out, where, "byteOffset", Need::optional, 0, kLargestNumber);
  number(in, out, where, "count", Need::required, 1, kLargestNumber);
  number(in, out, where, "componentType", Need::required, 5120, 5126);
  text(in, out, where, "type", Need::required);
  constexpr std::array<const char*, 7> types = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
  if (std::find(types.begin(), types.end(), out["type"].get_ref<const std::string&>()) == types.end())
    wrongField(where + ".type", out["type"], "SCALAR, VEC2 to VEC4 or MAT2 to MAT4");
  if (const json* normalized = find(in, where, "normalized", Need::optional)) {
    if (!normalized->is_boolean()) wrongField(where + ".normalized", *normalized, "true or false");
    out["normalized"] = *normalized;
  }
  const json* sparse = find(in, where, "sparse", Need::optional);
  if (!sparse) return out;
  if (!sparse->is_object()) wrongField(where + ".sparse", *sparse, "an object");
  json& checked = out["sparse"] = json::object();
  number(*sparse, checked, where + ".sparse", "count", Need::required, 1, kLargestInt);
  for (const char* name : {"indices", "values"}) {
    const std::string inside = where + ".sparse." + name;
    const json* part = find(*sparse, where + ".sparse", name, Need::required);
    if (!part->is_object()) wrongField(inside, *part, "an object");
    checked[name] = json::object();
    reference(*part, checked[name], inside, "bufferView", "bufferViews", Need::required);
    number(*part, checked[name], inside, "byteOffset", Need::optional, 0, kLargestInt);
    if (std::string_view(name) == "indices") number(*part, checked[name], inside, "componentType", Need::required, 5120, 5126);
  }
  return out;
}

json Checker::bufferView(const json& in, const std::string& where) const {
  json out = json::object();
  reference(in, out, where, "buffer", "buffers", Need::required);
  number(in, out, where, "byteOffset", Need::optional, 0, kLargestNumber);
  number(in, out, where, "byteLength", Need::required, 1, kLargestNumber);
  if (const auto stride = number(in, out, where, "byteStride", Need::optional, 4, 252); stride && *stride % 4 != 0)
    wrongField(where + ".byteStride", in["byteStride"], "a multiple of 4 from 4 to 252");
  return out;
}

json Checker::buffer(const json& in, const std::string& where) {
  json out = json::object();
  result_.buffer_bytes.push_back(*number(in, out, where, "byteLength", Need::required, 1, kLargestNumber));
  text(in, out, where, "uri");
  result_.buffer_uris.push_back(out.value("uri", ""));
  if (out.contains("uri") && result_.buffer_uris.back().empty()) wrongField(where + ".uri", out["uri"], "the name of a file");
  // The parser asks for each buffer by its number.
  out["uri"] = std::to_string(result_.buffer_uris.size() - 1);
  return out;
}

json Checker::primitive(const json& in, const std::string& where) {
  json out = json::object();
  number(in, out, where, "mode", Need::optional, 0, 6);
  reference(in, out, where, "indices", "accessors");
  const json* attributes = find(in, where, "attributes", Need::required);
  if (!attributes->is_object()) wrongField(where + ".attributes", *attributes, "an object");
  json& checked = out["attributes"] = json::object();
  for (const auto& [name, value] : attributes->items())
    checked[name] = indexInto("accessors", value, where + ".attributes." + printable(name));
  result_.deforms = result_.deforms || in.contains("targets");
  return out;
}

json Checker::mesh(const json& in, const std::string& where) {
  json out = json::object();
  text(in, out, where, "name");
  const json* primitives = find(in, where, "primitives", Need::required);
  if (!primitives->is_array()) wrongField(where + ".primitives", *primitives, "an array");
  json& checked = out["primitives"] = json::array();
  for (size_t i = 0; i < primitives->size(); ++i) {
    const std::string inside = where + ".primitives[" + std::to_string(i) + "]";
    if (!(*primitives)[i].is_object()) wrongField(inside, (*primitives)[i], "an object");
    checked.push_back(primitive((*primitives)[i], inside));
  }
  return out;
}

json Checker::node(const json& in, const std::string& where) {
  json out = json::object();
  text(in, out, where, "name");
  reference(in, out, where, "mesh", "meshes");
  references(in, out, where, "children", "nodes");
  numbers(in, out, where, "matrix", 16);
  numbers(in, out, where, "translation", 3);
  numbers(in, out, where, "rotation", 4);
  numbers(in, out, where, "scale", 3);
  result_.deforms = result_.deforms || in.contains("skin");
  return out;
}

json Checker::scene(const json& in, const std::string& where) const {
  json out = json::object();
  references(in, out, where, "nodes", "nodes");
  return out;
}

// A material says nothing of strands, so that a damaged one is as good as none.
std::optional<std::array<float, 3>> firstBaseColor(const json& root) {
  const json nothing;
  const auto child = [&](const json& in, const char* name) -> const json& {
    const auto found = in.is_object() ? in.find(name) : in.end();
    return found != in.end() ? *found : nothing;
  };
  const json& materials = child(root, "materials");
  const json& factor = child(child(materials.is_array() && !materials.empty() ? materials[0] : nothing, "pbrMetallicRoughness"), "baseColorFactor");
  if (!factor.is_array() || factor.size() < 3) return {};
  std::array<float, 3> color{};
  for (size_t i = 0; i < 3; ++i) {
    if (!factor[i].is_number()) return {};
    const double value = factor[i].get<double>();
    if (!(value >= 0 && value <= 1)) return {};
    color[i] = float(value);
  }
  return color;
}

CheckedGltf Checker::run() {
  if (!root_.is_object()) refuseGltf("GLTF_JSON", "its JSON is " + shown(root_) + " where glTF has an object: it is no glTF file");
  json& document = result_.document = json::object();
  const json* asset = find(root_, "the file", "asset", Need::required);
  if (!asset->is_object()) wrongField("asset", *asset, "an object");
  document["asset"] = json::object();
  text(*asset, document["asset"], "asset", "version", Need::required);
  text(*asset, document["asset"], "asset", "minVersion");
  const std::string version = document["asset"].value("minVersion", document["asset"]["version"].get<std::string>());
  if (version.rfind("2.", 0) != 0)
    refuseGltf("GLTF_VERSION", "asset.version is " + printable(version) + ": glTF 2.0 is read, export it as that", FLK_ERROR_FORMAT_UNKNOWN);
  extensionNames("extensionsUsed");
  extensionNames("extensionsRequired");
  section("buffers", [&](const json& in, const std::string& where) { return buffer(in, where); });
  section("bufferViews", [&](const json& in, const std::string& where) { return bufferView(in, where); });
  section("accessors", [&](const json& in, const std::string& where) { return accessor(in, where); });
  section("meshes", [&](const json& in, const std::string& where) { return mesh(in, where); });
  section("nodes", [&](const json& in, const std::string& where) { return node(in, where); });
  section("scenes", [&](const json& in, const std::string& where) { return scene(in, where); });
  reference(root_, document, "the file", "scene", "scenes");
  result_.base_color = firstBaseColor(root_);
  return std::move(result_);
}

}  // namespace

CheckedGltf checkGltfJson(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  checkNesting(text);
  json root;
  try {
    root = json::parse(text.begin(), text.end());
  } catch (const json::parse_error& error) {
    refuseGltf("GLTF_JSON", "its JSON is damaged at byte " + std::to_string(error.byte) + " of " + std::to_string(text.size()) +
                                (error.byte >= text.size() ? " (it ends too early)" : "") + ": fetch or export the file again");
  } catch (const json::out_of_range&) {
    refuseGltf("GLTF_JSON", "its JSON holds a number that no 64-bit float can hold: export the file again");
  }
  return Checker(root).run();
}

}  // namespace forelock::samples
