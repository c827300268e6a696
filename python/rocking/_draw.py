"""Small drawings for notebooks, as SVG in HTML."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

WIDTH, HEIGHT, MARGIN = 320.0, 180.0, 28.0
# A line of more points than this is thinned: it has a few hundred pixels.
MOST_POINTS = 400


def caption(words: str, drawing: str = "") -> str:
    """A drawing above its words."""
    return (
        f"<figure>{drawing}<figcaption>{escape(words)}</figcaption></figure>"
    )


def _svg(parts: Sequence[str]) -> str:
    size = f'width="{WIDTH:g}" height="{HEIGHT:g}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size}>'
    return head + "".join(parts) + "</svg>"


def _text(x: float, y: float, words: str, anchor: str = "middle") -> str:
    place = f'x="{x:g}" y="{y:g}" text-anchor="{anchor}" font-size="10"'
    return f'<text {place} fill="currentColor">{escape(words)}</text>'


def lines(
    curves: Sequence[tuple[Floats, Floats]],
    x_name: str,
    y_name: str,
    words: str,
) -> str:
    """Curves (x, y) in one frame; what is not finite is left out."""
    kept = []
    for x, y in curves:
        good = np.isfinite(x) & np.isfinite(y)
        step = max(1, int(good.sum()) // MOST_POINTS)
        kept.append((x[good][::step], y[good][::step]))
    kept = [(x, y) for x, y in kept if len(x) > 0]
    if not kept:
        return caption(words)
    xs = np.concatenate([x for x, _ in kept])
    ys = np.concatenate([y for _, y in kept])
    (x0, x1), (y0, y1) = (xs.min(), xs.max()), (ys.min(), ys.max())
    wide, high = WIDTH - 2.0 * MARGIN, HEIGHT - 2.0 * MARGIN
    parts = [
        f'<rect x="{MARGIN:g}" y="{MARGIN:g}" width="{wide:g}" '
        f'height="{high:g}" fill="none" stroke="currentColor" '
        'stroke-opacity="0.4"/>'
    ]
    for x, y in kept:
        px = MARGIN + wide * (x - x0) / ((x1 - x0) or 1.0)
        py = MARGIN + high * (y1 - y) / ((y1 - y0) or 1.0)
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(px, py))
        parts.append(
            f'<polyline points="{points}" fill="none" stroke="#1f77b4" '
            'stroke-opacity="0.7"/>'
        )
    bottom = HEIGHT - 0.5 * MARGIN
    parts.append(_text(MARGIN, bottom, f"{x0:.3g}"))
    parts.append(_text(WIDTH - MARGIN, bottom, f"{x1:.3g}"))
    parts.append(_text(0.5 * WIDTH, bottom, x_name))
    parts.append(_text(2.0, HEIGHT - MARGIN, f"{y0:.3g}", "start"))
    parts.append(_text(2.0, MARGIN + 4.0, f"{y1:.3g}", "start"))
    parts.append(_text(0.5 * WIDTH, 0.6 * MARGIN, y_name))
    return caption(words, _svg(parts))


def block(width: float, height: float, words: str) -> str:
    """A block of this width and height on its base."""
    scale = (HEIGHT - 2.0 * MARGIN) / max(width, height)
    w, h = scale * width, scale * height
    left, base = 0.5 * (WIDTH - w), HEIGHT - MARGIN
    parts = [
        f'<rect x="{left:.1f}" y="{base - h:.1f}" width="{w:.1f}" '
        f'height="{h:.1f}" fill="#1f77b4" fill-opacity="0.3" '
        'stroke="currentColor"/>',
        f'<line x1="{MARGIN:g}" x2="{WIDTH - MARGIN:g}" y1="{base:g}" '
        f'y2="{base:g}" stroke="currentColor"/>',
        _text(0.5 * WIDTH, base + 14.0, f"{width:.3g} m x {height:.3g} m"),
    ]
    return caption(words, _svg(parts))
