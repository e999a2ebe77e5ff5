"""Finds the 22 joints among the nodes of a BVH file by the names that programs give them.

The rules are those of the page's reader (web/motion), so that a file means the same dancer in training and there.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from training.data.bvh.file import Node
from training.motion.skeleton import JOINTS

OWN_NAMES: dict[str, str] = {
    "pelvis": "Hips",
    "left_hip": "LeftUpLeg",
    "right_hip": "RightUpLeg",
    "spine1": "Spine",
    "left_knee": "LeftLeg",
    "right_knee": "RightLeg",
    "spine2": "Spine1",
    "left_ankle": "LeftFoot",
    "right_ankle": "RightFoot",
    "spine3": "Spine2",
    "left_foot": "LeftToeBase",
    "right_foot": "RightToeBase",
    "neck": "Neck",
    "left_collar": "LeftShoulder",
    "right_collar": "RightShoulder",
    "head": "Head",
    "left_shoulder": "LeftArm",
    "right_shoulder": "RightArm",
    "left_elbow": "LeftForeArm",
    "right_elbow": "RightForeArm",
    "left_wrist": "LeftHand",
    "right_wrist": "RightHand",
}
"""What the files written by this project call the joints; a file with exactly these needs no rule for the trunk."""

_LIMBS = ("hip", "knee", "ankle", "foot", "shoulder", "elbow", "wrist", "collar")
_NEEDED = ("hip", "knee", "ankle", "shoulder", "elbow", "wrist")
_WORDS, _LETTERS = ("left", "right"), ("l", "r")


@dataclass(frozen=True)
class _Convention:
    """How a family of programs names the joints of a limb, `*` for the side, in the order of _LIMBS; names are
    compared in lower case without prefix, namespace and punctuation."""

    prefix: str
    sides: tuple[tuple[str, str], ...]
    limbs: tuple[tuple[str, ...], ...]
    neck: tuple[str, ...] = ("neck",)
    head: tuple[str, ...] = ("head",)
    trunk: tuple[str, ...] = ()


def _limbs(text: str) -> tuple[tuple[str, ...], ...]:
    return tuple(tuple(words.split()) for words in text.split(","))


_HUMAN_IK = _limbs("*upleg, *leg, *foot, *toebase *toe, *arm, *forearm, *hand, *shoulder")
_BIPED = _limbs("*thigh, *calf, *foot, *toebase *toe0 *toe, *upperarm, *forearm, *hand, *clavicle")
_CONVENTIONS: dict[str, _Convention] = {
    "Mixamo": _Convention(r"mixamorig\d*[:_]?", (_WORDS,), _HUMAN_IK),
    "Character Creator": _Convention(r"cc_base_", (_LETTERS,), _BIPED, neck=("neck", "necktwist01")),
    "Biped": _Convention(r"(valvebiped[._])?bip\d+[ _-]?", (_LETTERS,), _BIPED, neck=("neck", "necktwist01")),
    "SMPL": _Convention(
        "",
        (_WORDS, _LETTERS),
        _limbs("*hip, *knee, *ankle, *foot, *shoulder, *elbow, *wrist, *collar"),
        trunk=("pelvis", "spine1", "spine2", "spine3"),
    ),
    "CMU / MotionBuilder": _Convention("", (_WORDS,), _HUMAN_IK),
    "DAZ": _Convention(
        "",
        (_LETTERS,),
        _limbs(
            "*thigh *thighbend, *shin, *foot, *toe *toes, *shldr *shldrbend *upperarm, *forearm *forearmbend, *hand, "
            "*collar *shoulder"
        ),
        neck=("neck", "necklower", "neck1"),
    ),
}


def _plain(name: str, convention: _Convention) -> str | None:
    """The name as it is compared; None where it lacks the convention's prefix."""
    if convention.prefix:
        prefix = re.match(convention.prefix, name, re.IGNORECASE)
        if not prefix:
            return None
        name = name[prefix.end() :]
    return re.sub(r"[^a-z0-9]", "", re.sub(r"^.*[:|]", "", name).lower())


def _find(nodes: list[Node], convention: _Convention, sides: tuple[str, str]) -> dict[str, int]:
    by_name: dict[str, int] = {}
    for index, node in enumerate(nodes):
        word = None if node.end_site else _plain(node.name, convention)
        if word is not None:
            by_name.setdefault(word, index)
    wanted = [
        (f"{side}_{limb}", tuple(word.replace("*", sides[k]) for word in words))
        for limb, words in zip(_LIMBS, convention.limbs, strict=True)
        for k, side in enumerate(_WORDS)
    ]
    wanted += [("neck", convention.neck), ("head", convention.head)]
    wanted += [(joint, (joint,)) for joint in convention.trunk]
    found: dict[str, int] = {}
    for joint, words in wanted:
        for word in words:
            if word in by_name and by_name[word] not in found.values():
                found[joint] = by_name[word]
                break
    return found


def _score(convention: _Convention, found: dict[str, int]) -> int:
    if not all(joint in found for joint in convention.trunk):
        return 0
    return sum(f"{side}_{limb}" in found for limb in _NEEDED for side in _WORDS) + (
        "neck" in found or "head" in found
    )


def find_joints(nodes: list[Node]) -> tuple[str, dict[str, int], bool]:
    """Dialect, node of every joint that the file has, and whether it has our very trunk.

    Raises ValueError that names the missing joints when a limb, or both neck and head, cannot be found.
    """
    names = [node.name for node in nodes if not node.end_site]
    if sorted(names) == sorted(OWN_NAMES.values()):
        at = {node.name: index for index, node in enumerate(nodes) if not node.end_site}
        return "own", {joint: at[OWN_NAMES[joint]] for joint in JOINTS}, True
    best_name, best, best_score = "", {}, -1
    for name, convention in _CONVENTIONS.items():
        for sides in convention.sides:
            found = _find(nodes, convention, sides)
            if (score := _score(convention, found)) > best_score:
                best_name, best, best_score = name, found, score
    missing = [f"{side} {limb}" for limb in _NEEDED for side in _WORDS if f"{side}_{limb}" not in best]
    if "neck" not in best and "head" not in best:
        missing.append("neck or head")
    if missing:
        raise ValueError(
            f"no joint was found for {', '.join(missing)}; the file has {', '.join(names[:8])}, ..."
        )
    return best_name, best, bool(_CONVENTIONS[best_name].trunk)


def back_nodes(nodes: list[Node], found: dict[str, int]) -> list[int]:
    """Nodes between the hips and the neck (or head), upwards: the bend of the back."""

    def above(index: int) -> list[int]:
        chain = []
        while (index := nodes[index].parent) >= 0:
            chain.append(index)
        return chain

    below = {*above(found["left_hip"]), *above(found["right_hip"])}
    chain = above(found.get("neck", found.get("head", 0)))
    fork = next((k for k, node in enumerate(chain) if node in below), 0)
    return chain[:fork][::-1]
