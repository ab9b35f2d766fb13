// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/contact/contact_space_piece.h"

namespace phongpd::internal {

// "i/n".
std::string ToText(PieceNumber number);

// The pieces in the order of what they hold: i/n is the i-th n-th of a build,
// and so are 2i/2n and 2i+1/2n together.  Throws InputError, naming them, where
// some are of another build, hold the same, or do not hold all of it.
std::vector<const ContactSpacePiece::Data*> InOrder(
    const std::vector<ContactSpacePiece>& pieces);

}  // namespace phongpd::internal
