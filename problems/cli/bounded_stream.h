// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <httplib.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <string>

namespace phongpd::cli {

// A connection of which no more than `most_bytes` are read, and those within
// `seconds` from its beginning, whatever their pace; then it has ended.  So has
// one that takes nothing for `seconds` while it is written to.  httplib itself
// bounds bodies and pauses only.
class BoundedStream : public httplib::Stream {
 public:
  // The socket stays its maker's.
  BoundedStream(socket_t socket, std::size_t most_bytes, double seconds);

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool IsReady(short events, Clock::time_point deadline) const;

  socket_t socket_;
  std::size_t left_;  // bytes that may come
  Clock::duration patience_;
  Clock::time_point deadline_;
  std::array<char, 4096> buffer_{};  // headers are asked for byte by byte
  std::size_t begin_ = 0, end_ = 0;  // of what waits in it
};

}  // namespace phongpd::cli
