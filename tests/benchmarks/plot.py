"""The picture of the tables: speed, building and scaling, as PNG, drawn by matplotlib."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from tests.benchmarks.report import Table

# Okabe and Ito's colours, which a colour-blind reader can tell apart.
COLORS = ("#D55E00", "#0072B2", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")
SIZE_INCHES, DPI = (10.5, 7.0), 110


def draw(tables: list[Table], path: Path) -> bool:
    """Writes the picture; False where no table has anything to show. Needs matplotlib."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    data = {table.name: table.data for table in tables}
    panels = [
        (_speed, data.get("visibility", [])),
        (_building, data.get("build", [])),
        (_triangles, [d for d in data.get("scaling", []) if d["axis"] == "triangles"]),
        (_pixels, [d for d in data.get("scaling", []) if d["axis"] == "pixels"]),
    ]
    panels = [(panel, rows) for panel, rows in panels if rows]
    if not panels:
        return False
    columns = min(2, len(panels))
    figure, axes = pyplot.subplots(
        -(-len(panels) // columns), columns, figsize=SIZE_INCHES, squeeze=False
    )
    for axis in axes.flat[len(panels) :]:
        axis.set_axis_off()
    for axis, (panel, rows) in zip(axes.flat, panels, strict=False):
        panel(axis, rows)
        axis.spines[["top", "right"]].set_visible(False)
    handles, labels = axes.flat[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=len(labels), frameon=False)
    figure.tight_layout(rect=(0, 0.05, 1, 1))
    figure.savefig(path, dpi=DPI)
    pyplot.close(figure)
    return True


def _speed(axis: Any, rows: list[dict[str, Any]]) -> None:
    """Bars: millions of rays a second, perspective, the smallest size."""
    rows = [row for row in rows if row["view"] == "perspective"]
    rows = [row for row in rows if row["size"] == rows[0]["size"]]
    names = list(rows[0]["times"])
    width = 0.8 / len(names)
    for k, name in enumerate(names):
        speeds = [
            row["size"][0] * row["size"][1] / row["times"][name]["median_s"] / 1e6 for row in rows
        ]
        at = [i + (k - (len(names) - 1) / 2) * width for i in range(len(rows))]
        bars = axis.bar(at, speeds, width, label=name, color=COLORS[k])
        axis.bar_label(bars, fmt="{:.0f}", fontsize=7)
    axis.set_xticks(range(len(rows)), [f"{row['triangles']:,} triangles" for row in rows])
    width_px, height_px = rows[0]["size"]
    axis.set_title(f"Mrays/s, {width_px}x{height_px}: t, primitive and normal of each pixel")


def _building(axis: Any, rows: list[dict[str, Any]]) -> None:
    _lines(axis, rows, "triangles", [row["triangles"] for row in rows])
    axis.set_title("Building, ms")


def _triangles(axis: Any, rows: list[dict[str, Any]]) -> None:
    _lines(axis, rows, "triangles", [row["triangles"] for row in rows])
    axis.set_title("An image of 1280x720, ms")


def _pixels(axis: Any, rows: list[dict[str, Any]]) -> None:
    _lines(axis, rows, "pixels", [row["size"][0] * row["size"][1] for row in rows])
    axis.set_title(f"An image of {rows[0]['triangles']:,} triangles, ms")


def _lines(axis: Any, rows: list[dict[str, Any]], label: str, x: list[int]) -> None:
    for k, name in enumerate(rows[0]["times"]):
        y = [1e3 * row["times"][name]["median_s"] for row in rows]
        axis.plot(x, y, marker="o", label=name, color=COLORS[k])
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xticks(x, [short_count(number) for number in x])
    axis.set_xticks([], minor=True)
    axis.yaxis.set_major_formatter("{x:g}")
    axis.set_xlabel(label)
    axis.grid(alpha=0.3)


def short_count(number: int) -> str:
    """3.7M, 70k."""
    return f"{number / 1e6:.2g}M" if number >= 999_500 else f"{number / 1e3:.3g}k"
