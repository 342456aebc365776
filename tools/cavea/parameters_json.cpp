#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "cavea/base/error.h"
#include "parameters.h"

namespace cavea::program {
namespace {

using Json = nlohmann::json;

/// A value and where in the text it stands, as a JSON pointer.
struct Place {
  const Json& json;
  std::string file, pointer;

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}: {}", file, pointer.empty() ? "/" : pointer, what));
  }
  Place at(const std::string& key) const { return {json.at(key), file, pointer + "/" + key}; }
  Place at(std::size_t i) const { return {json.at(i), file, fmt::format("{}/{}", pointer, i)}; }
  bool has(const std::string& key) const { return json.contains(key); }

  /// Refuses what is no object, and keys that are not known.
  void expect_keys(const std::set<std::string>& known) const {
    if (!json.is_object()) fail("an object is due");
    for (const auto& [key, value] : json.items())
      if (!known.count(key)) fail(fmt::format("the key \"{}\" is not known", key));
  }
  void expect_array(std::size_t length) const {
    if (!json.is_array() || json.size() != length)
      fail(fmt::format("an array of {} is due", length));
  }
  Place need(const std::string& key) const {
    if (!has(key)) fail(fmt::format("the key \"{}\" is missing", key));
    return at(key);
  }
  double number() const {
    if (!json.is_number()) fail("a number is due");
    return json.get<double>();
  }
  std::int32_t reference() const {
    using Range = std::numeric_limits<std::int32_t>;
    if (!json.is_number_integer() || json < Range::min() || json > Range::max())
      fail("a whole number of 32 bits is due");
    return json.get<std::int32_t>();
  }
  Vec3 point() const {
    expect_array(3);
    return {at(0).number(), at(1).number(), at(2).number()};
  }
};

/// Runs f on each element of the array at a key, if it is there.
template <class F>
void for_each(const Place& place, const std::string& key, F&& f) {
  if (!place.has(key)) return;
  const Place list = place.at(key);
  if (!list.json.is_array()) list.fail("an array is due");
  for (std::size_t i = 0; i < list.json.size(); ++i) f(list.at(i));
}

/// Of two keys the one that is there, which says what the entry is about.
std::string one_of(const Place& place, const std::string& a, const std::string& b) {
  if (place.has(a) == place.has(b))
    place.fail(fmt::format("one of the keys \"{}\" and \"{}\" is due", a, b));
  return place.has(a) ? a : b;
}

/// The library's own judgement, with the place.
template <class T>
T valid(const Place& place, const T& value) {
  try {
    validate_entry(value);
  } catch (const OptionError& e) {
    place.fail(e.what());
  }
  return value;
}

LocalParameters local_of(const Place& place) {
  place.expect_keys({"triangles", "tetrahedra", "hmin", "hmax", "hausd"});
  const std::string entity = one_of(place, "triangles", "tetrahedra");
  const auto optional = [&](const char* key) {
    return place.has(key) ? std::optional(place.at(key).number()) : std::nullopt;
  };
  using Entity = LocalParameters::Entity;
  return valid(place, LocalParameters{entity == "triangles" ? Entity::kTriangles : Entity::kTets,
                                      place.at(entity).reference(), optional("hmin"),
                                      optional("hmax"), optional("hausd")});
}

SizeRegion region_of(const Place& place) {
  place.expect_keys({"box", "sphere", "size"});
  const std::string shape = one_of(place, "box", "sphere");
  const double size = place.need("size").number();
  const Place at = place.at(shape);
  if (shape == "box") {
    at.expect_array(2);
    return valid(place, SizeRegion{SizeBox{at.at(0).point(), at.at(1).point(), size}});
  }
  at.expect_keys({"center", "radius"});
  return valid(place,
               SizeRegion{SizeSphere{at.need("center").point(), at.need("radius").number(), size}});
}

/// Parses, and refuses a key given twice in one object: the parser would take the last.
Json parse(const std::string& text, const std::string& name) {
  std::vector<std::set<std::string>> open;
  const auto watch = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) open.emplace_back();
    if (event == Json::parse_event_t::object_end) open.pop_back();
    if (event == Json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second)
      throw InputError(fmt::format("{}: the key {} is given twice", name, value.dump()));
    return true;
  };
  try {
    return Json::parse(text, watch);
  } catch (const Json::exception& e) {
    throw InputError(fmt::format("{}: {}", name, e.what()));  // tells line and column
  }
}

}  // namespace

Parameters parse_parameters_json(const std::string& text, const std::string& name) {
  const Json json = parse(text, name);
  const Place root{json, name, ""};
  root.expect_keys({"local", "regions"});
  Parameters parameters;
  for_each(root, "local", [&](const Place& p) { parameters.local.push_back(local_of(p)); });
  for_each(root, "regions", [&](const Place& p) { parameters.regions.push_back(region_of(p)); });
  return parameters;
}

}  // namespace cavea::program
