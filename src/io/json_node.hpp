#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace nda::io {

/// Throws InputError "invalid JSON: ...".
nlohmann::json parse_json(std::string_view text);

/// A place in a JSON document that knows its name: a typed read that fails says
/// "solutions[0].arcs[3][1]: expected a whole number up to 7, found \"x\"" (InputError).
///
/// Children point to their parents, which must outlive them; the name is put together on failure
/// only.
class JsonNode {
 public:
  explicit JsonNode(const nlohmann::json& value) : value_(value) {}

  /// The member of an object; throws when this is no object or lacks it.
  JsonNode operator[](const char* key) const;

  /// Whether it is an object with that member.
  bool has(const char* key) const { return value_.is_object() && value_.contains(key); }

  /// Number of elements of an array; throws when this is none.
  std::size_t size() const;

  /// Element i < size() of an array.
  JsonNode operator[](std::size_t i) const { return JsonNode(value_[i], this, nullptr, i); }

  /// A whole number 0..largest.
  std::uint64_t whole(std::uint64_t largest) const;

  /// A number, or "inf" or "-inf".
  double number() const;

  bool boolean() const;
  const std::string& text() const;

  [[noreturn]] void fail(const std::string& message) const;

 private:
  JsonNode(const nlohmann::json& value, const JsonNode* parent, const char* key, std::size_t index)
      : value_(value), parent_(parent), key_(key), index_(index) {}

  [[noreturn]] void fail_expected(const std::string& what) const;
  std::string name() const;

  const nlohmann::json& value_;
  const JsonNode* parent_ = nullptr;
  const char* key_ = nullptr;  // null for an element of an array
  std::size_t index_ = 0;
};

}  // namespace nda::io
