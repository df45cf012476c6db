# SPDX-License-Identifier: BSD-3-Clause
"""A car before a wall, as stereo images without any library: the camera drives straight at it."""
import os
import random
import struct
import zlib

WIDTH, HEIGHT, FOCAL, CX, CY, BASELINE = 320, 200, 200, 160, 80, 0.5  # [px], [m]
CAMERA_HEIGHT, WALL, CAR, STEP = 1.5, 14, 8, 0.2  # [m]; distances from the first camera, and what it drives a frame
CALIB = ''.join(f'P{i}: {FOCAL} 0 {CX} {-FOCAL * BASELINE * (i % 2)} 0 {FOCAL} {CY} 0 0 0 1 0\n' for i in range(4))
CAR_BOX = (CX - 25, CY, CX + 25, CY + 37)  # in the first image: 2 m wide, 1.5 m high

_dice = random.Random(1)
_DOTS, _DOTS_A_METRE = [[_dice.randrange(30, 220) for _ in range(256)] for _ in range(256)], 8
_GREY = [bytes(range(256))] * 3
_RED = [bytes(int(gain * value) for value in range(256)) for gain in (0.2, 0.2, 1)]  # of B, G, R


def _line(x, y, depth, first, last):
    """Pixels [first, last) of a row that shows what lies `depth` before a camera at x; y: row of the pattern [m]."""
    row, part = divmod(y * _DOTS_A_METRE, 1)
    above, below = _DOTS[int(row) % 256], _DOTS[(int(row) + 1) % 256]
    dots = [(1 - part) * a + part * b for a, b in zip(above, below)]
    dots.append(dots[0])
    step = depth / FOCAL * _DOTS_A_METRE
    start = x * _DOTS_A_METRE - CX * step + 256 * 8
    line = bytearray()
    for u in range(first, last):
        column, part = divmod(start + u * step, 1)
        column = int(column) % 256
        line.append(int((1 - part) * dots[column] + part * dots[column + 1]))
    return bytes(line)


def look(x, z):
    """Rows of bytes B G R, as seen by a camera that is x to the right and z before the first one."""
    rows = []
    for v in range(HEIGHT):
        down = v + 0.5 - CY
        ground = FOCAL * CAMERA_HEIGHT / down if down > 0 else WALL
        depth = min(ground, WALL - z)
        grey = _line(x, depth + z if depth == ground else 100 + down * depth / FOCAL, depth, 0, WIDTH)
        row = bytearray(3 * WIDTH)
        for channel in range(3):
            row[channel::3] = grey.translate(_GREY[channel])
        depth = CAR - z
        if 0 <= down * depth / FOCAL <= CAMERA_HEIGHT:
            first, last = (round(CX + FOCAL * (side - x) / depth) for side in (-1, 1))
            grey = _line(x, 200 + down * depth / FOCAL, depth, first, last)
            for channel in range(3):
                row[3 * first + channel:3 * last:3] = grey.translate(_RED[channel])
        rows.append(bytes(row))
    return rows


def write_png(path, rows, channels=3):
    """Rows of bytes: B G R, or grey."""
    def chunk(kind, body):
        return struct.pack('>I', len(body)) + kind + body + struct.pack('>I', zlib.crc32(kind + body))

    def as_rgb(row):
        rgb = bytearray(row)
        rgb[0::3], rgb[2::3] = row[2::3], row[0::3]
        return bytes(rgb)

    pixels = b''.join(b'\0' + (as_rgb(row) if channels == 3 else row) for row in rows)
    header = struct.pack('>IIBBBBB', len(rows[0]) // channels, len(rows), 8, 2 if channels == 3 else 0, 0, 0, 0)
    with open(path, 'wb') as file:
        file.write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(pixels, 1)) + chunk(b'IEND', b''))


def write_drive(folder, frames):
    """calib.txt, image_2, image_3, boxes.txt: no more than `sslcd_run detect` needs."""
    for index, name in enumerate(('image_2', 'image_3')):
        os.makedirs(f'{folder}/{name}')
        for i in range(frames):
            write_png(f'{folder}/{name}/{i:06d}.png', look(index * BASELINE, STEP * i))
    boxes = []
    for i in range(frames):
        zoom = CAR / (CAR - STEP * i)
        left, top, right, bottom = CAR_BOX
        boxes.append(f'{i} Car 0.9 {CX + zoom * (left - CX):.1f} {CY + zoom * (top - CY):.1f} '
                     f'{CX + zoom * (right - CX):.1f} {CY + zoom * (bottom - CY):.1f}\n')
    for name, text in (('calib.txt', CALIB), ('boxes.txt', ''.join(boxes))):
        with open(f'{folder}/{name}', 'w') as file:
            file.write(text)
