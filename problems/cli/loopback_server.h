// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace phongpd::cli {

struct ServedAnswer {
  int status = 200;  // of HTTP
  std::string json;  // {"error": "one line"} unless the status is 200
};

struct LoopbackOptions {
  int port = 0;  // 0: any that is free
  std::size_t most_body_bytes = std::size_t{1} << 16U;
  double request_seconds = 5.0;  // for all of a request to come
};

// What is served; the functions are called by several threads.
struct Served {
  std::string page;
  std::function<ServedAnswer(const std::string&)> solve;
  std::function<ServedAnswer()> cancel;
};

// A page and a question, on 127.0.0.1 alone:
//   GET  /TOKEN/        the page
//   POST /TOKEN/solve   JSON; the answer to its body
//   POST /TOKEN/cancel  any JSON; ends the question that is being answered
// Everything else is refused by CheckRequest (serve_guard.h); no file is ever
// read, no header lets other sites in, one request a connection.
class LoopbackServer {
 public:
  // Listens from here on.  Throws InputError where the port cannot be had, and
  // where the program was built without the package libcpp-httplib-dev.
  explicit LoopbackServer(const LoopbackOptions& options);
  ~LoopbackServer();
  LoopbackServer(const LoopbackServer&) = delete;
  LoopbackServer& operator=(const LoopbackServer&) = delete;

  // "http://127.0.0.1:PORT/TOKEN/"
  const std::string& address() const;

  // Answers until Stop or a signal ends it.
  void Run(const Served& served);
  void Stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Throws InputError where the program was built without what serves.
void RequireServer();

}  // namespace phongpd::cli
