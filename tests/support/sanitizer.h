// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// gcc defines the one, clang has the other.
#if defined(__SANITIZE_ADDRESS__)
#define PHONGPD_ADDRESS_SANITIZER 1
#elif defined(__SANITIZE_THREAD__)
#define PHONGPD_THREAD_SANITIZER 1
#elif defined(__has_feature)
#define PHONGPD_ADDRESS_SANITIZER __has_feature(address_sanitizer)
#define PHONGPD_THREAD_SANITIZER __has_feature(thread_sanitizer)
#endif
#ifndef PHONGPD_ADDRESS_SANITIZER
#define PHONGPD_ADDRESS_SANITIZER 0
#endif
#ifndef PHONGPD_THREAD_SANITIZER
#define PHONGPD_THREAD_SANITIZER 0
#endif

namespace phongpd::testing {

// The address sanitizer keeps back what is freed (its quarantine has 256 MiB),
// which a limit of memory sees as in use.
inline constexpr bool kKeepsFreedMemory = PHONGPD_ADDRESS_SANITIZER;

// They take terabytes of address space.
inline constexpr bool kIsSanitized =
    PHONGPD_ADDRESS_SANITIZER || PHONGPD_THREAD_SANITIZER;

}  // namespace phongpd::testing
