// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

// Who may ask the server of `view --serve`: the page that it handed out, and
// programs of the user's that know its token.  Whoever else can reach the
// loopback address, a page of another site in the user's browser above all, is
// told so and learns nothing.
namespace phongpd::cli {

// A request as far as its body.  Headers that may come more than once have all
// values.
struct RequestHead {
  std::string method;
  std::string path;  // decoded, without what follows "?"
  std::vector<std::string> hosts, origins, fetch_sites, content_types, lengths;
  bool is_encoded = false;  // transfer or content encoding of the body
};

struct ServeRules {
  std::string token;
  int port = 0;
  std::size_t most_bytes = 0;  // of a body
};

// What is said instead; status 0: the request may pass.
struct Refusal {
  int status = 0;  // of HTTP
  std::string why;
};

// The first of these that does not hold:
//   421  Host is 127.0.0.1, localhost or [::1] with the port: a name that
//        somebody lets point here is another site
//   403  Origin is that site, if there is one; and Sec-Fetch-Site says so
//   403  the path begins with the token, compared in one time
//   404  nothing follows, or "solve", or "cancel"
//   405  GET of the page, POST of the others
//   411  a body has a plain length ...
//   413  ... that is not too large
//   415  ... and says that it is JSON, which no form of a page can
Refusal CheckRequest(const RequestHead& head, const ServeRules& rules);

// Equal, in a time that does not tell where they differ.
bool IsSameToken(const std::string& a, const std::string& b);

// 128 bits of the system's random numbers, in hexadecimal digits.
std::string NewToken();

}  // namespace phongpd::cli
