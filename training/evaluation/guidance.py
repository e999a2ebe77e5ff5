"""Whether coarse and fine guidance are two controls: each should move its own end of the spectrum and leave the
other.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

STRENGTH = 1.2  # the paper's guidance, compared with none

# Which energy of `probes.measure_guidance` a layer's guidance is meant for, and which it should leave alone.
OWN = {"coarse": "slow_energy", "fine": "quick_energy"}
OTHER = {"coarse": "quick_energy", "fine": "slow_energy"}


def separability(cells: Sequence[Mapping[str, float]]) -> dict[str, float]:
    """Relative change of energy when one layer's guidance rises from 0 to 1.2 and the other's stays 0.

    cells: of a guidance grid. `LAYER_moves_own` is taken under 1.5 Hz for coarse and over 3 Hz for fine,
    `LAYER_moves_other` at the opposite end; 0.05 is 5 % more energy. Layers whose cells are not in the grid
    are left out.
    """
    by_guidance = {(cell["coarse"], cell["fine"]): cell for cell in cells}
    none = by_guidance.get((0.0, 0.0))
    raised = {"coarse": by_guidance.get((STRENGTH, 0.0)), "fine": by_guidance.get((0.0, STRENGTH))}
    result: dict[str, float] = {}
    for layer, cell in raised.items():
        if none is not None and cell is not None:
            for name, energy in (("own", OWN[layer]), ("other", OTHER[layer])):
                result[f"{layer}_moves_{name}"] = cell[energy] / none[energy] - 1
    return result
