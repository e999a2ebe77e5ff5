"""Finds the 22 joints among the nodes of a BVH file, by skeleton convention: the joint names of a family of programs.

The rules are those of the page (web/motion/retarget/conventions.ts and joint-map.ts) for the first six of its
conventions; it reads others too (VRM and Unity, Unreal, Rigify, SOMA, OptiTrack, Rokoko, Xsens, ASF, MMD, generic
names).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from training.data.bvh.file import Node
from training.motion.skeleton import JOINTS

BVH_NAMES: dict[str, str] = {
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
"""Names of the joints in files that the page writes (MotionBuilder's HumanIK); a file with exactly these has all 22."""

# The point below the hips on which the page's files hang the body.
_REFERENCE = "Reference"

_LIMBS = ("hip", "knee", "ankle", "foot", "shoulder", "elbow", "wrist", "collar")
_REQUIRED = ("hip", "knee", "ankle", "shoulder", "elbow", "wrist")
_SIDE_WORDS, _SIDE_LETTERS = ("left", "right"), ("l", "r")


@dataclass(frozen=True)
class _Convention:
    """Skeleton convention: the joint names that a family of programs uses.

    Names are compared in lower case without prefix, namespace, spaces and punctuation. limbs: names of each of _LIMBS,
    `*` for the side. prefix: beginning of every name, a regular expression. sides: words for left and right. trunk:
    names of pelvis, spine1, spine2 and spine3 where the convention has exactly these joints.
    """

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
    "Mixamo": _Convention(r"mixamorig\d*[:_]?", (_SIDE_WORDS,), _HUMAN_IK),
    "Character Creator": _Convention(r"cc_base_", (_SIDE_LETTERS,), _BIPED, neck=("neck", "necktwist01")),
    "Biped": _Convention(
        r"(valvebiped[._])?bip\d+[ _-]?", (_SIDE_LETTERS,), _BIPED, neck=("neck", "necktwist01")
    ),
    "SMPL": _Convention(
        "",
        (_SIDE_WORDS, _SIDE_LETTERS),
        _limbs("*hip, *knee, *ankle, *foot, *shoulder, *elbow, *wrist, *collar"),
        trunk=("pelvis", "spine1", "spine2", "spine3"),
    ),
    "CMU / MotionBuilder": _Convention("", (_SIDE_WORDS,), _HUMAN_IK),
    "DAZ": _Convention(
        "",
        (_SIDE_LETTERS,),
        _limbs(
            "*thigh *thighbend, *shin, *foot, *toe *toes, *shldr *shldrbend *upperarm, *forearm *forearmbend, *hand, "
            "*collar *shoulder"
        ),
        neck=("neck", "necklower", "neck1"),
    ),
}


def _normalised_name(name: str, convention: _Convention) -> str | None:
    """A node's name in the form that is compared; None where it lacks the convention's prefix."""
    if convention.prefix:
        prefix = re.match(convention.prefix, name, re.IGNORECASE)
        if not prefix:
            return None
        name = name[prefix.end() :]
    return re.sub(r"[^a-z0-9]", "", re.sub(r"^.*[:|]", "", name).lower())


def _find(nodes: list[Node], convention: _Convention, sides: tuple[str, str]) -> dict[str, int]:
    """The node of every joint that a convention has a name for; no node stands for two joints."""
    by_name: dict[str, int] = {}
    for index, node in enumerate(nodes):
        word = None if node.end_site else _normalised_name(node.name, convention)
        if word is not None:
            by_name.setdefault(word, index)
    wanted = [
        (f"{side}_{limb}", tuple(word.replace("*", sides[k]) for word in words))
        for limb, words in zip(_LIMBS, convention.limbs, strict=True)
        for k, side in enumerate(_SIDE_WORDS)
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
    """Number of required joints that were found; 0 where a joint of the convention's own trunk is missing."""
    if not all(joint in found for joint in convention.trunk):
        return 0
    return sum(f"{side}_{limb}" in found for limb in _REQUIRED for side in _SIDE_WORDS) + (
        "neck" in found or "head" in found
    )


def is_page_file(nodes: list[Node]) -> bool:
    """Whether the page wrote the file: it has the page's joints and the point from which it hangs the body."""
    names = [node.name for node in nodes if not node.end_site]
    return sorted(names) == sorted([*BVH_NAMES.values(), _REFERENCE])


def find_joints(nodes: list[Node]) -> tuple[dict[str, int], bool]:
    """The node of every joint that the file has, and whether the file has the SMPL trunk.

    Taken is the convention of which most joints are found. With the SMPL trunk (pelvis, spine1, spine2, spine3) none of
    these four is estimated. Raises ValueError that names the missing joints when a limb, or both neck and head, cannot
    be found.
    """
    names = [node.name for node in nodes if not node.end_site]
    if sorted(name for name in names if name != _REFERENCE) == sorted(BVH_NAMES.values()):
        at = {node.name: index for index, node in enumerate(nodes) if not node.end_site}
        return {joint: at[BVH_NAMES[joint]] for joint in JOINTS}, True
    best_name, best, best_score = "", {}, -1
    for name, convention in _CONVENTIONS.items():
        for sides in convention.sides:
            found = _find(nodes, convention, sides)
            if (score := _score(convention, found)) > best_score:
                best_name, best, best_score = name, found, score
    missing = [f"{side} {limb}" for limb in _REQUIRED for side in _SIDE_WORDS if f"{side}_{limb}" not in best]
    if "neck" not in best and "head" not in best:
        missing.append("neck or head")
    if missing:
        raise ValueError(
            f"no joint was found for {', '.join(missing)}; the file has {', '.join(names[:8])}, ..."
        )
    return best, bool(_CONVENTIONS[best_name].trunk)


def spine_nodes(nodes: list[Node], found: dict[str, int]) -> list[int]:
    """Nodes of the spine between the hips and the neck (or head), upwards."""

    def above(index: int) -> list[int]:
        chain = []
        while (index := nodes[index].parent) >= 0:
            chain.append(index)
        return chain

    below = {*above(found["left_hip"]), *above(found["right_hip"])}
    chain = above(found.get("neck", found.get("head", 0)))
    fork = next((k for k, node in enumerate(chain) if node in below), 0)
    return chain[:fork][::-1]
