// SPDX-License-Identifier: GPL-3.0-or-later
// Where the package libcpp-httplib-dev was not there when this was built.
#include "core/mesh/mesh_error.h"
#include "problems/cli/loopback_server.h"

namespace phongpd::cli {

struct LoopbackServer::Impl {
  std::string address;
};

void RequireServer() {
  throw InputError(
      "--serve: expected a program built with cpp-httplib, found one without; "
      "install the package libcpp-httplib-dev and build it again");
}

LoopbackServer::LoopbackServer(const LoopbackOptions&) { RequireServer(); }
LoopbackServer::~LoopbackServer() = default;
const std::string& LoopbackServer::address() const { return impl_->address; }
void LoopbackServer::Run(const Served&) {}
void LoopbackServer::Stop() {}

}  // namespace phongpd::cli
