"""What the drivers of faults have in common: small scenes, runs under watch, what a run may leave, and the table."""
import argparse
import hashlib
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
PATIENCE = 20  # [s] after which a run hangs
CLOTH = 6      # vertices along a side

SCENE = """billow: 1
duration: 0.2
bodies:
  - name: sheet
    cloth:
      mesh: cloth.obj
      mass: 0.2
      stiffness: {structural: 115, shear: 80, bend: 35}
      pins: [{corner: top_left}]
    colour: "#808080"
solver: {method: fb_euler, step: auto, filter: {kernel: exponential, lambda: 1}}
render:
  size: [64, 48]
  fps: 25
  views: [textured, velocity]
  camera: {eye: [0.5, 0, 3], look_at: [0.5, -0.3, 0.5], fov: 40}
strip: {step: 0.01}
caches: [pc2, obj, glb]
"""


def grid_obj(side=CLOTH):
    lines = []
    for row in range(side):
        for column in range(side):
            lines.append(f'v {column / (side - 1)} 0 {row / (side - 1)}')
            lines.append(f'vt {column / (side - 1)} {1 - row / (side - 1)}')
    for row in range(side - 1):
        for column in range(side - 1):
            a = row * side + column + 1
            lines.append('f ' + ' '.join(f'{v}/{v}' for v in (a, a + side, a + side + 1, a + 1)))
    return '\n'.join(lines) + '\n'


def write_scene(folder, text=SCENE, name='scene.yaml'):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / 'cloth.obj').write_text(grid_obj())
    (folder / name).write_text(text)
    return folder / name


class Result:
    def __init__(self, status, output, errors, seconds):
        self.status, self.output, self.errors, self.seconds = status, output, errors, seconds


def run(words, environment=None, patience=PATIENCE, prepare=None, folder=None):
    """Runs a program to its end; status 128 + signal where one ended it, None where it had to be ended."""
    begin = time.monotonic()
    process = subprocess.Popen([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               stdin=subprocess.DEVNULL, env={**os.environ, **(environment or {})},
                               preexec_fn=prepare, cwd=folder)
    try:
        output, errors = process.communicate(timeout=patience)
        status = process.returncode if process.returncode >= 0 else 128 - process.returncode
    except subprocess.TimeoutExpired:
        process.kill()
        output, errors = process.communicate()
        status = None
    return Result(status, output.decode(errors='replace'), errors.decode(errors='replace'), time.monotonic() - begin)


# Files that hold times.
CHANGING = {'run.json', 'index.html'}


def digests(folder):
    """Of every file below a folder, by its path there."""
    return {str(file.relative_to(folder)): hashlib.sha256(file.read_bytes()).hexdigest()
            for file in sorted(folder.rglob('*')) if file.is_file()}


def strays(folder):
    return [str(file.relative_to(folder)) for file in folder.rglob('*.part')]


def differences(folder, reference):
    """Files under their final names that are not what they should be. `reference`: digests of a whole run."""
    return [name for name, digest in digests(folder).items()
            if pathlib.PurePath(name).name not in CHANGING and not name.endswith('.part')
            and reference.get(name) != digest]


def missing(folder, reference):
    return [name for name in reference if not (folder / name).exists()]


def standing(folder):
    """The status in run.json; '' without one, None for one that cannot be read."""
    record = folder / 'run.json'
    if not record.exists():
        return ''
    try:
        return json.loads(record.read_text())['status']
    except (ValueError, KeyError):
        return None


def crashed(result):
    """Complaints about how a process ended, whatever its work."""
    if result.status is None:
        return ['hangs']
    if result.status >= 126:
        return [f'status {result.status}: {result.errors.strip()[:200]}']
    if result.status != 0 and not result.errors.strip():
        return [f'status {result.status} without a word']
    if 'internal fault' in result.errors or 'terminate called' in result.errors:
        return [result.errors.strip()[:200]]
    return []


def left_wrong(folder, reference, result, killed=False):
    """Complaints about what a run that met a fault has left. `killed`: nothing could be tidied."""
    if not folder.exists():
        return []
    wrong = [f'{name} is not what it should be' for name in differences(folder, reference)]
    if not killed:
        wrong += [f'{name} is left' for name in strays(folder)]
    says = standing(folder)
    if result.status == 0:
        wrong += [f'{name} is missing' for name in missing(folder, reference)]
    if says is None:
        wrong.append('run.json cannot be read')
    elif result.status == 0 and says != 'done':
        wrong.append(f'run.json says "{says}" of a whole run')
    elif result.status != 0 and says == 'done' and missing(folder, reference):
        wrong.append(f'run.json says "done", and {missing(folder, reference)[0]} is missing')
    elif result.status != 0 and says == 'running' and not killed:
        wrong.append(f'run.json says "{says}", and the status is {result.status}')
    return wrong


def resumed_wrong(billow, scene, folder, reference, more=()):
    """Complaints about the run that goes on from there."""
    result = run([billow, 'render', scene, '-o', folder, '--resume', '--progress', 'none', *more])
    if result.status != 0:
        return [f'--resume: status {result.status}: {result.errors.strip()[:200]}']
    wrong = [f'--resume: {name} is left' for name in strays(folder)]
    found = digests(folder)
    wrong += [f'--resume: {name} is not what it should be' for name, digest in reference.items()
              if pathlib.PurePath(name).name not in CHANGING and found.get(name) != digest]
    if standing(folder) != 'done':
        wrong.append(f'--resume: run.json says "{standing(folder)}"')
    return wrong


class Table:
    """A line for each kind of fault: name | tries | failures. What failed is said on stderr."""

    def __init__(self):
        self.failed = 0

    def line(self, name, tries, failures):
        print(f'{name:<58} | {tries:>6} | {len(failures):>6}', flush=True)
        for failure in failures[:5]:
            print(f'    {failure}', file=sys.stderr, flush=True)
        self.failed += len(failures)

    def status(self):
        return 1 if self.failed else 0


def arguments(text):
    parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('billow', help='the tool')
    parser.add_argument('--quick', action='store_true', help='a small part, for the tests')
    parser.add_argument('--seed', type=int, default=1)
    options = parser.parse_args()
    options.billow = str(pathlib.Path(options.billow).resolve())
    return options


def chosen(dice, total, most):
    """Up to `most` of the numbers 1 to total: the first and the last few, and others by chance."""
    if total <= most:
        return list(range(1, total + 1))
    edge = max(1, most // 8)
    fixed = set(range(1, edge + 1)) | set(range(total - edge + 1, total + 1))
    others = [number for number in range(1, total + 1) if number not in fixed]
    dice.shuffle(others)
    return sorted(fixed | set(others[:most - len(fixed)]))


def workplace():
    return tempfile.TemporaryDirectory(prefix='billow-faults-')


def reference_run(billow, folder, text=SCENE, more=()):
    """A whole run of a scene in `folder`, and its digests."""
    scene = write_scene(folder, text)
    result = run([billow, 'render', scene, '-o', folder / 'whole', '--progress', 'none', *more])
    if result.status != 0:
        sys.exit(f'the reference run ended with {result.status}: {result.errors}')
    return scene, digests(folder / 'whole')


def dice(options):
    return random.Random(options.seed)
