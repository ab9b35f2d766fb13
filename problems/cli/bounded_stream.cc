// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/bounded_stream.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace phongpd::cli {

BoundedStream::BoundedStream(socket_t socket, std::size_t most_bytes,
                             double seconds)
    : socket_(socket),
      left_(most_bytes),
      patience_(std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(seconds))),
      deadline_(Clock::now() + patience_) {}

bool BoundedStream::IsReady(short events, Clock::time_point deadline) const {
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    if (left.count() <= 0) return false;
    pollfd wait = {socket_, events, 0};
    const int ready = poll(&wait, 1, static_cast<int>(left.count()));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

bool BoundedStream::is_readable() const {
  return begin_ < end_ || IsReady(POLLIN, deadline_);
}

bool BoundedStream::is_writable() const {
  return IsReady(POLLOUT, Clock::now() + patience_);
}

ssize_t BoundedStream::read(char* to, std::size_t size) {
  if (begin_ == end_) {
    const std::size_t most = std::min(buffer_.size(), left_);
    if (most == 0 || !IsReady(POLLIN, deadline_)) return -1;
    ssize_t got = 0;
    do {
      got = recv(socket_, buffer_.data(), most, 0);
    } while (got < 0 && errno == EINTR);
    if (got <= 0) return got;
    begin_ = 0;
    end_ = static_cast<std::size_t>(got);
    left_ -= end_;
  }
  const std::size_t taken = std::min(size, end_ - begin_);
  std::memcpy(to, buffer_.data() + begin_, taken);
  begin_ += taken;
  return static_cast<ssize_t>(taken);
}

ssize_t BoundedStream::write(const char* from, std::size_t size) {
  if (!is_writable()) return -1;
  ssize_t sent = 0;
  do {
    sent = send(socket_, from, size, MSG_NOSIGNAL);
  } while (sent < 0 && errno == EINTR);
  return sent;
}

// Nobody asks: only requests from this machine come at all.
void BoundedStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

void BoundedStream::get_local_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

}  // namespace phongpd::cli
