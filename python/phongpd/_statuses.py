# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from typing import ClassVar, Tuple

import numpy as np
from numpy.typing import NDArray


class Statuses:
    """Answers of which each row has a status: a number, and a word for it."""

    WORDS: ClassVar[Tuple[str, ...]]
    status: NDArray[np.uint8]

    @property
    def statuses(self) -> list[str]:
        """The words, a row each."""
        return [self.WORDS[s] for s in self.status]

    def __len__(self) -> int:
        return len(self.status)
