// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the modules of pages have in common.  What a page hands over has passed
// the checks of the program that wrote it, or those of the page; an exception
// stops the module, and the page says why.

#define PAGE_EXPORT(name) extern "C" __attribute__((export_name(#name), used))

// Of the page: says why nothing goes on, and does not return.
extern "C" __attribute__((import_module("page"), import_name("fail"))) void
FailPage(const char* why);
