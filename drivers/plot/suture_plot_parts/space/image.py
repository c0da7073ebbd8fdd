"""Colours of a raster's samples, and the resulting image."""
import numpy as np

LIGHT = np.array([-0.2, 0.35, 1.0]) / np.linalg.norm([-0.2, 0.35, 1.0])  # to the right, upward, towards the viewer
AMBIENT = 0.76
SMOOTH = np.cos(np.radians(40.0))  # normals that differ by less belong to one smooth surface
UNKNOWN = np.array([0.75, 0.75, 0.75])


def brightness(view, points, triangles, normal):
    """Brightness at the corners of the triangles under a light next to the viewer, smooth where their normals nearly agree."""
    order = np.argsort(triangles.reshape(-1), kind="stable")
    vertex, owner = triangles.reshape(-1)[order], order // 3
    starts = np.flatnonzero(np.concatenate([[True], vertex[1:] != vertex[:-1]])) if len(vertex) else np.zeros(0, dtype=int)
    count = np.diff(np.append(starts, len(vertex)))
    begin, many = np.repeat(starts, count), np.repeat(count, count)
    total = normal[owner].copy()
    for shift in range(1, int(count.max(initial=1))):
        rows = np.flatnonzero(many > shift)
        other = normal[owner[begin[rows] + (rows - begin[rows] + shift) % many[rows]]]
        near = np.einsum("ij,ij->i", normal[owner[rows]], other) > SMOOTH
        total[rows[near]] += other[near]
    total /= np.maximum(np.linalg.norm(total, axis=1), 1e-300)[:, None]
    lit = AMBIENT + (1 - AMBIENT) * np.clip(total @ (np.column_stack([view.right, view.up, view.toward]) @ LIGHT), 0, 1)
    result = np.empty(len(order))
    result[order] = lit
    return result.reshape(-1, 3)


def colour_table(values, low, high, colours):
    """(rows of red, green, blue; the row of each value) for values between `low` and `high`; grey for NaN."""
    table = np.vstack([colours(np.linspace(0, 1, 1024))[:, :3], UNKNOWN]).astype(np.float32)
    part = np.clip((values - low) * (1023 / ((high - low) or 1.0)) + 0.5, 0, 1023)
    return table, np.where(np.isfinite(part), part, 1024).astype(np.int16)


def coloured(values, low, high, colours):
    """Rows of red, green, blue for values between `low` and `high`; grey for NaN."""
    table, row = colour_table(values, low, high, colours)
    return table[row]


def packed(colours, light=None):
    """Rows of red, green, blue as opaque pixels of four bytes."""
    bytes4 = np.full((len(colours), 4), 255, dtype=np.uint8)
    shade = np.float32(255.0) if light is None else (255 * light).astype(np.float32)[:, None]
    bytes4[:, :3] = np.asarray(colours, dtype=np.float32) * shade + np.float32(0.5)
    return bytes4.view(np.uint32)[:, 0]


def image_of_pixels(raster, pixels):
    """The image as bytes of red, green, blue and opacity, the lowest row first. `pixels`: at the raster's samples, see packed()"""
    image = np.zeros((*raster.shape, 4), dtype=np.uint8)
    image.view(np.uint32).reshape(-1)[raster.samples] = pixels
    return image


def picture(raster, colours, light=None):
    """The image of colours, rows of red, green, blue, at the raster's samples."""
    return image_of_pixels(raster, packed(colours, light))
