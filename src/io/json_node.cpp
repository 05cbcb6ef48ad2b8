#include "io/json_node.hpp"

#include <algorithm>

#include "io/scanner.hpp"
#include "nda/types.hpp"

namespace nda::io {
namespace {

// The message of nlohmann-json without its error number; it quotes from the input, so it is cut and
// anything unprintable is masked.
std::string syntax_message(const nlohmann::json::exception& error) {
  constexpr std::size_t kLongest = 200;
  std::string message = error.what();
  const std::size_t start = message.find("] ");
  if (start != std::string::npos) message.erase(0, start + 2);
  if (message.size() > kLongest) message.replace(kLongest, std::string::npos, "...");
  std::replace_if(
      message.begin(), message.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "invalid JSON: " + message;
}

}  // namespace

nlohmann::json parse_json(std::string_view text) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(syntax_message(error));
  }
}

JsonNode JsonNode::operator[](const char* key) const {
  if (!value_.is_object()) fail_expected("an object");
  const auto member = value_.find(key);
  if (member == value_.end()) fail("field '" + std::string(key) + "' is missing");
  return JsonNode(*member, this, key, 0);
}

std::size_t JsonNode::size() const {
  if (!value_.is_array()) fail_expected("an array");
  return value_.size();
}

std::uint64_t JsonNode::whole(std::uint64_t largest) const {
  if (!value_.is_number_unsigned() || value_.get<std::uint64_t>() > largest) {
    fail_expected("a whole number up to " + std::to_string(largest));
  }
  return value_.get<std::uint64_t>();
}

double JsonNode::number() const {
  if (value_.is_number()) return value_.get<double>();
  if (value_ == "inf") return kInfinity;
  if (value_ == "-inf") return -kInfinity;
  fail_expected("a number, \"inf\" or \"-inf\"");
}

bool JsonNode::boolean() const {
  if (!value_.is_boolean()) fail_expected("true or false");
  return value_.get<bool>();
}

const std::string& JsonNode::text() const {
  if (!value_.is_string()) fail_expected("a string");
  return value_.get_ref<const std::string&>();
}

void JsonNode::fail(const std::string& message) const {
  const std::string place = name();
  throw InputError(place.empty() ? message : place + ": " + message);
}

void JsonNode::fail_expected(const std::string& what) const {
  fail("expected " + what + ", found " +
       (value_.is_structured() ? std::string(value_.type_name()) : in_quotes(value_.dump())));
}

std::string JsonNode::name() const {
  if (parent_ == nullptr) return "";
  const std::string before = parent_->name();
  if (key_ == nullptr) return before + '[' + std::to_string(index_) + ']';
  return before.empty() ? key_ : before + '.' + key_;
}

}  // namespace nda::io
