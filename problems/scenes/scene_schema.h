// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace phongpd::internal {

// The text of scene.schema.json, compiled in.
extern const char* const kSceneSchema;

}  // namespace phongpd::internal
