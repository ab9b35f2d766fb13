// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/loopback_server.h"

#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "problems/cli/bounded_stream.h"
#include "problems/cli/serve_guard.h"
#include "problems/output/json_text.h"

namespace phongpd::cli {
namespace {

constexpr char kLoopback[] = "127.0.0.1";
constexpr std::size_t kMostHeadBytes = std::size_t{1} << 14U;
constexpr std::size_t kConnections = 4;  // served at once; others wait

// A page runs nothing but itself, asks nobody but this server, and is part of
// no other page.
const char* const kPageHeaders[][2] = {
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; "
     "style-src 'unsafe-inline'; img-src data: blob:; connect-src 'self'; "
     "frame-ancestors 'none'; base-uri 'none'; form-action 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cache-Control", "no-store"},
    {"Connection", "close"}};

std::vector<std::string> HeaderValues(const httplib::Request& request,
                                      const std::string& name) {
  std::vector<std::string> values;
  const auto [first, last] = request.headers.equal_range(name);
  for (auto it = first; it != last; ++it) values.push_back(it->second);
  return values;
}

RequestHead HeadOf(const httplib::Request& request) {
  RequestHead head;
  head.method = request.method;
  head.path = request.path;
  head.hosts = HeaderValues(request, "Host");
  head.origins = HeaderValues(request, "Origin");
  head.fetch_sites = HeaderValues(request, "Sec-Fetch-Site");
  head.content_types = HeaderValues(request, "Content-Type");
  head.lengths = HeaderValues(request, "Content-Length");
  head.is_encoded = request.has_header("Transfer-Encoding") ||
                    request.has_header("Content-Encoding");
  return head;
}

void TellTo(const ServedAnswer& answer, httplib::Response* response) {
  response->status = answer.status;
  response->set_content(answer.json, "application/json");
}

ServedAnswer Refused(int status, const std::string& why) {
  return {status, JsonText({{"error", why}})};
}

// One request a connection, by streams that are bounded.
class BoundedServer : public httplib::Server {
 public:
  explicit BoundedServer(const LoopbackOptions& options) : options_(options) {}

 private:
  bool process_and_close_socket(socket_t socket) override {
    BoundedStream stream(socket, kMostHeadBytes + options_.most_body_bytes,
                         options_.request_seconds);
    bool is_closed = false;
    const bool done = process_request(stream, true, is_closed, nullptr);
    shutdown(socket, SHUT_RDWR);
    close(socket);
    return done;
  }

  LoopbackOptions options_;
};

// The port alone: nobody else may listen on it as well.
void SetSocket(socket_t socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

}  // namespace

struct LoopbackServer::Impl {
  explicit Impl(const LoopbackOptions& options) : server(options) {}

  BoundedServer server;
  ServeRules rules;
  std::string address;
};

void RequireServer() {}

LoopbackServer::LoopbackServer(const LoopbackOptions& options)
    : impl_(std::make_unique<Impl>(options)) {
  BoundedServer& server = impl_->server;
  server.set_socket_options(SetSocket);
  server.set_payload_max_length(options.most_body_bytes);
  server.new_task_queue = [] { return new httplib::ThreadPool(kConnections); };
  int port = options.port;
  if (port == 0) {
    port = server.bind_to_any_port(kLoopback);
  } else if (!server.bind_to_port(kLoopback, port)) {
    port = -1;
  }
  if (port <= 0) {
    throw InputError("--port: expected one that can be had on " +
                     std::string(kLoopback) + ", found " +
                     std::to_string(options.port) +
                     "; take another, or 0 for any");
  }
  impl_->rules = {NewToken(), port, options.most_body_bytes};
  impl_->address = std::string("http://") + kLoopback + ":" +
                   std::to_string(port) + "/" + impl_->rules.token + "/";
}

LoopbackServer::~LoopbackServer() { Stop(); }

const std::string& LoopbackServer::address() const { return impl_->address; }

void LoopbackServer::Run(const Served& served) {
  BoundedServer& server = impl_->server;
  using Handled = httplib::Server::HandlerResponse;
  server.set_pre_routing_handler(
      [this](const httplib::Request& request, httplib::Response& response) {
        for (const auto& [name, value] : kPageHeaders) {
          response.set_header(name, value);
        }
        const Refusal refusal = CheckRequest(HeadOf(request), impl_->rules);
        if (refusal.status == 0) return Handled::Unhandled;
        TellTo(Refused(refusal.status, refusal.why), &response);
        return Handled::Handled;
      });
  // All that comes here has passed the rules.
  server.Get("/[0-9a-f]+/", [&served](const auto&, auto& response) {
    response.set_content(served.page, "text/html; charset=utf-8");
  });
  server.Post("/[0-9a-f]+/solve",
              [&served](const httplib::Request& request, auto& response) {
                TellTo(served.solve(request.body), &response);
              });
  server.Post("/[0-9a-f]+/cancel", [&served](const auto&, auto& response) {
    TellTo(served.cancel(), &response);
  });
  server.set_exception_handler(
      [](const auto&, auto& response, const std::exception_ptr&) {
        TellTo(Refused(500, "internal error"), &response);
      });
  server.listen_after_bind();
}

void LoopbackServer::Stop() { impl_->server.stop(); }

}  // namespace phongpd::cli
