"""The table of the paper's measures."""

from __future__ import annotations

from training.evaluation.report.paper_table import COLUMNS, OTHER_DANCES, paper_table


def test_every_measure_of_the_paper_has_a_column_and_rows_that_were_not_measured_are_left_out() -> None:
    mean = {key: 10.0 + place for place, (_, key, _) in enumerate(COLUMNS)} | {"bed_forward_chance": 0.2}
    numbers = {
        "rows": {"truth": {"mean": mean}, "generated": {"mean": mean | {"fid_cd": float("nan")}}},
        "seconds": {"mean": 0.8064},
    }
    head, _, truth, generated = paper_table(numbers).splitlines()
    for name in ["FID_k", "FID_g", "FID_cd", "Div_k", "MPJPE", "MPJVE", "PFC", "IPR", "BED", "seconds"]:
        assert name in head
    assert truth.startswith("| truth | 10 | 11 | 12.0 | 13.0 |")
    assert "| 21.00 (0.20) | 22.00 |  |" in truth, "the truth takes no time"
    assert generated.startswith("| **generated** | 10 | 11 | – | 13.0 |")
    assert generated.endswith("| 0.8 |")


def test_what_other_true_dances_have_stands_under_the_truth() -> None:
    row = {"mean": {key: 1.0 for _, key, _ in COLUMNS} | {"bed_forward_chance": 0.2}}
    numbers = {
        "rows": {"truth": row, "generated": row},
        "seconds": {"mean": 1.0},
        "other_dances": {
            "fid_k": [128.0, 31.0, 420.0],
            "fid_g": [13.7, 11.2, 18.8],
            "fid_cd": [14.8, 5.6, 58.0],
        },
    }
    lines = paper_table(numbers).splitlines()
    assert lines[3].startswith(f"| {OTHER_DANCES} | 128 | 14 | 14.8 |  |")
    assert {line.count("|") for line in lines} == {len(COLUMNS) + 3}
    assert len(paper_table(numbers | {"other_dances": {}}).splitlines()) == 4
