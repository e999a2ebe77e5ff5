"""The manifest: every number that the page needs, written once from the trained model's own configuration."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date
from typing import Any

from training.config import CONTROLS, FPS, STREAMS, STRIDE, from_json, to_json
from training.diffusion.decode import RECEPTIVE_FIELD
from training.diffusion.model import Model
from training.diffusion.schedule import alphas_cumprod
from training.evaluation.metrics import beats, contact, penetration, seams
from training.evaluation.out_of_distribution import GLIDE_RATIO, GLIDE_REACH, GLIDE_SPEED
from training.motion import foot_contact
from training.motion.floor import TOE_PERCENTILE, TOE_REST
from training.motion.skeleton import FEET, JOINTS, LOWER, PARENTS, UPPER
from training.music.recipe import AudioRecipe

FORMAT, VERSION = "reactdance-model", 10
LAYERS = ("coarse", "fine")
ROLES = ("reactor", "leader")


@dataclass(frozen=True)
class Card:
    """What a person should know about a model before using it."""

    id: str
    name: str
    licence: str
    data_licence: str
    attribution: str
    notes: tuple[str, ...]
    reference_height: float  # metres, `body_height` of the leaders it was trained on
    reactor_height: float  # metres, `body_height` of the reactors beside those leaders
    training_bodies: dict[str, list[list[float]]]
    """By role the rest offsets (22, 3), metres at the reference height, of the dancers of the training."""
    unfamiliar_from: float  # mean unfamiliarity of a leader from which the model does not know such a dance


def make_card(values: dict[str, Any]) -> Card:
    """The card of the values of a card.json. Raises ValueError for an unknown or missing one, and notes in one text."""
    if not isinstance(values.get("notes", []), list):
        raise ValueError('notes are a list of sentences, ["...", "..."]')
    return from_json(Card, values)


def condition_field(model: Model) -> int:
    """Latent frames on each side of a chunk that its memory depends on: smoothing, velocity, convolutions."""
    return -(-(model.frame.radius + 1) // STRIDE) + model.denoiser.condition.receptive_field


def quality_rules() -> dict[str, Any]:
    """Constants of the measures that the page takes too, so that its numbers are those of the evaluation."""
    return {
        "contact": {
            "percentile": foot_contact.PERCENTILE,
            "height": foot_contact.HEIGHT,
            "vertical_speed": foot_contact.VERTICAL_SPEED,
            "slide_speed": contact.SLIDE_SPEED,
        },
        "penetration": {
            "capsules": [
                {"from": first, "to": last, "radius": radius, "beyond": beyond}
                for first, last, radius, beyond in penetration.CAPSULES
            ],
            "reference_height": penetration.REFERENCE_HEIGHT,
            "deep": penetration.DEEP,
        },
        "beats": {"smoothing": beats.SMOOTHING, "tolerance": beats.TOLERANCE},
        "seams": {"radius": seams.RADIUS, "clear": seams.CLEAR},
        "glide": {"ratio": GLIDE_RATIO, "reach": GLIDE_REACH, "free_speed": GLIDE_SPEED},
    }


def manifest(
    model: Model, card: Card, entries: dict[str, dict[str, Any]], golden: dict[str, Any]
) -> dict[str, Any]:
    """The manifest as plain JSON values.

    `entries` are the graphs as described by `onnx_files.describe`, `golden` is the file of the golden tensors as
    described by `onnx_files.describe_file`.
    """
    diffusion = model.diffusion
    return {
        "format": FORMAT,
        "version": VERSION,
        "id": card.id,
        "name": card.name,
        "created": date.today().isoformat(),
        "licence": {"weights": card.licence, "data": card.data_licence},
        "attribution": card.attribution,
        "notes": list(card.notes),
        "skeleton": {
            "joints": list(JOINTS),
            "parents": list(PARENTS),
            "upper": list(UPPER),
            "lower": list(LOWER),
            "feet": list(FEET),
            "reference_height": round(card.reference_height, 4),
            "bodies": {
                role: [[round(value, 5) for value in offset] for offset in body.tolist()]
                for role, body in zip(ROLES, model.denoiser.bodies, strict=True)
            },
            "training_bodies": card.training_bodies,
            "reactor_height": round(card.reactor_height, 4),
            "floor": {"toe_rest": TOE_REST, "percentile": TOE_PERCENTILE},
        },
        "fps": FPS,
        "leader": {"unfamiliar_from": card.unfamiliar_from},
        "latent": {
            "stride": STRIDE,
            "block": model.denoiser.config.block,
            "channels": model.denoiser.latent_width,
            "streams": list(STREAMS),
            "layers": list(LAYERS),
            "memory_width": model.denoiser.condition.memory_width,
            "receptive_field": {"condition": condition_field(model), "decode": RECEPTIVE_FIELD},
        },
        "diffusion": {
            "train_steps": diffusion.train_steps,
            "alphas_cumprod": [float(f"{a:.10g}") for a in alphas_cumprod(diffusion)],
            "sampler": "ddim",
            "prediction": "x0",
            "clamp": "quantiser range",
            "last_time": diffusion.last_time,
            "steps": diffusion.steps,
        },
        "guidance": {
            "convention": {
                "coarse": "cond + s (cond - uncond), sampled latents of the coarse layer",
                "music": "+ m (cond - silent), sampled latents of all layers",
                "variety": "+ (v - 1) (cond - mean over the seeds), sampled latents of the coarse layer",
                "fine": "(1 + s) times the fine layer, decoded after the clamp",
            },
            "coarse": _range("coarse", diffusion.guidance[0]),
            "fine": _range("fine", diffusion.guidance[1]),
            "music": _range("music", diffusion.music_guidance),
            "variety": {**_range("variety", diffusion.variety), "seeds": diffusion.mean_seeds},
        },
        "noise": {"algorithm": "philox4x32-10"},
        "decode": {"foot_contact": diffusion.foot_contact},
        "architecture": {
            "frame": to_json(model.frame),
            "hfsq": to_json(model.hfsq.config),
            "denoiser": to_json(model.denoiser.config),
        },
        "audio": AudioRecipe().to_dict(),
        "quality": quality_rules(),
        "graphs": entries,
        "golden": golden,
    }


def _range(control: str, default: float) -> dict[str, float]:
    """Least and greatest weight of a control, the distance between two of them, and the default.

    Raises ValueError for a default that the control does not reach.
    """
    limits = CONTROLS[control]
    if not limits.low <= default <= limits.high:
        raise ValueError(
            f"the default {default:g} of the control {control} is not between {limits.low:g} and {limits.high:g}: "
            "change it in denoiser.json, or the control in training/config.py"
        )
    return {"min": limits.low, "max": limits.high, "step": limits.step, "default": default}
