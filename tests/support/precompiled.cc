// SPDX-License-Identifier: GPL-3.0-or-later
// Owns the headers that test programs share precompiled; its main is gtest's.
