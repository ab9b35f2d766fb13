// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/serve_guard.h"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "core/mesh/mesh_error.h"

namespace phongpd::cli {
namespace {

bool IsOneOf(const std::vector<std::string>& values,
             const std::vector<std::string>& known) {
  return values.size() == 1 &&
         std::find(known.begin(), known.end(), values.front()) != known.end();
}

// "127.0.0.1:8000", ...
std::vector<std::string> Sites(int port, const std::string& scheme) {
  std::vector<std::string> sites;
  for (const char* name : {"127.0.0.1", "localhost", "[::1]"}) {
    sites.push_back(scheme + name + ":" + std::to_string(port));
  }
  return sites;
}

// "/TOKEN/rest": the token, and the rest after the second slash.
struct TokenPath {
  std::string token, rest;
  bool has_rest = false;
};

TokenPath SplitPath(const std::string& path) {
  TokenPath split;
  const std::size_t slash = path.find('/', 1);
  split.token = path.substr(std::min<std::size_t>(1, path.size()), slash - 1);
  split.has_rest = slash != std::string::npos;
  if (split.has_rest) split.rest = path.substr(slash + 1);
  return split;
}

// −1: none.
long long BodyLength(const std::vector<std::string>& lengths) {
  if (lengths.size() != 1) return -1;
  const std::string& text = lengths.front();
  if (text.empty() || text.size() > 18 ||
      text.find_first_not_of("0123456789") != std::string::npos) {
    return -1;
  }
  return std::stoll(text);
}

Refusal CheckBody(const RequestHead& head, const ServeRules& rules) {
  const long long length = BodyLength(head.lengths);
  if (length < 0 || head.is_encoded) {
    return {411, "expected a plain body with one Content-Length"};
  }
  if (static_cast<std::size_t>(length) > rules.most_bytes) {
    return {413, "expected at most " + std::to_string(rules.most_bytes) +
                     " bytes, found " + std::to_string(length)};
  }
  const std::string json = "application/json";
  if (head.content_types.size() != 1 ||
      head.content_types.front().substr(0, json.size()) != json) {
    return {415, "expected Content-Type: " + json};
  }
  return {};
}

}  // namespace

bool IsSameToken(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference |= static_cast<unsigned char>(a[i]) ^
                  static_cast<unsigned>(static_cast<unsigned char>(b[i]));
  }
  return difference == 0;
}

Refusal CheckRequest(const RequestHead& head, const ServeRules& rules) {
  if (!IsOneOf(head.hosts, Sites(rules.port, ""))) {
    return {421, "expected the host of this server"};
  }
  if (!head.origins.empty() &&
      !IsOneOf(head.origins, Sites(rules.port, "http://"))) {
    return {403, "expected a request of this server's page"};
  }
  if (!head.fetch_sites.empty() &&
      !IsOneOf(head.fetch_sites, {"same-origin", "none"})) {
    return {403, "expected a request of this server's page"};
  }
  const TokenPath path = SplitPath(head.path);
  if (!IsSameToken(path.token, rules.token)) {
    return {403, "expected the address that phongpd view --serve printed"};
  }
  const bool is_post = path.rest == "solve" || path.rest == "cancel";
  if (!path.has_rest || (!path.rest.empty() && !is_post)) {
    return {404, "there is nothing here"};
  }
  if (head.method != (is_post ? "POST" : "GET")) {
    return {405, std::string("expected ") + (is_post ? "POST" : "GET")};
  }
  return is_post ? CheckBody(head, rules) : Refusal();
}

std::string NewToken() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) !=
      static_cast<ssize_t>(bytes.size())) {
    throw InputError(std::string("--serve: no random numbers for a token (") +
                     std::strerror(errno) + ")");
  }
  constexpr char kDigits[] = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) {
    token += kDigits[byte >> 4U];
    token += kDigits[byte & 15U];
  }
  return token;
}

}  // namespace phongpd::cli
