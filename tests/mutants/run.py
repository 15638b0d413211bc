#!/usr/bin/env python3
"""Does the suite notice a fault? Puts each fault of mutants.json into a copy of the sources, builds the tests that
could notice, and runs them until one fails. Prints who caught it; exits 1 where nobody did.

    run.py SOURCE_DIR WORK_DIR [TEXT...]     only the faults whose file or description holds one of TEXT
    run.py SOURCE_DIR WORK_DIR --check       only looks whether each fault still has its one place in the sources
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

# The pinned hash of all plans would notice any change of a bit, and say nothing of what the other tests are worth.
NOT_THE_HASH = "--gtest_filter=-PlanHash.*"
DRAWN = ["filter_fit_test", "render_pages_test", "render_animation_test", "prune_test", "render_irregular_test", "render_layers_test", "render_panes_test",
         "render_lights_test", "render_shape_test", "render_test", "stress_frames_test"]
SUITES = {  # the quick ones first
    "src/core/": ["core_tests", "core_golden_tests", "core_extreme_tests", "core_laws_tests"],
    "src/scene/": ["load_gltf_test", "gltf_refusal_test", "gltf_confinement_test", "gltf_skin_test", "animation_test",
                   "scene_image_test", "camera_path_test", "builtin_scene_test", "default_view_test"],
    "src/casefile/": ["casefile_test"],
    "src/judge/": ["judge_test"],
    "src/report/": ["report_test"],
    "src/trace/": ["trace_test", "trace_scenes_test"],
    "src/render/": DRAWN,
    "shaders/": DRAWN,
    "src/stress/frames/": ["stress_frames_test"],
    "src/stress/random/": ["stress_random_test"],
    "src/tool/calibrate/": ["compare_test"],
    "src/tool/compare/": ["flips_law_test", "compare_test"],
    "src/tool/fly/": ["fly_test", "flythrough_test"],
    "src/tool/pages/": ["view_test", "flythrough_test", "compare_test"],
    "src/tool/view/": ["view_test", "tool_animation_test", "view_window_test"],
}
# What is built beside core, scene and case files, by the folder whose faults need it.
PARTS = {
    "src/scene/": ["TRACE"],
    "src/report/": ["REPORT"],
    "src/trace/": ["TRACE"],
    "src/render/": ["RENDER", "TRACE"],
    "shaders/": ["RENDER", "TRACE"],
    "src/stress/frames/": ["RENDER", "TRACE"],
    "src/tool/calibrate/": ["RENDER", "TRACE", "REPORT", "TOOL"],
    "src/tool/compare/": ["RENDER", "TRACE", "REPORT", "TOOL"],
    "src/tool/fly/": ["RENDER", "TRACE", "REPORT", "TOOL"],
    "src/tool/pages/": ["RENDER", "TRACE", "REPORT", "TOOL"],
    "src/tool/view/": ["RENDER", "TRACE", "REPORT", "TOOL"],
}
ALL_PARTS = ["RENDER", "TRACE", "REPORT", "TOOL", "SAMPLES", "BENCH"]
PATIENCE = 900  # seconds for one test program: a fault that never ends is caught, too


def folder_of(file):
    for folder in SUITES:
        if file.startswith(folder):
            return folder
    sys.exit(f"mutants: no tests are named for {file}")


def suite_of(file):
    return SUITES[folder_of(file)]


def tracked_files(source):
    listed = subprocess.run(["git", "-C", source, "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True)
    if listed.returncode == 0:
        return listed.stdout.split("\n")[:-1]
    return [str(p.relative_to(source)) for p in pathlib.Path(source).rglob("*") if p.is_file() and "build" not in p.parts]


def copy_sources(source, copy):
    """Only what differs is written, so that nothing is built anew for no reason."""
    wanted = set(tracked_files(source))
    for name in wanted:
        from_file, to_file = source / name, copy / name
        if not from_file.is_file():
            continue
        content = from_file.read_bytes()
        if not to_file.is_file() or to_file.read_bytes() != content:
            to_file.parent.mkdir(parents=True, exist_ok=True)
            to_file.write_bytes(content)
            shutil.copymode(from_file, to_file)


def run(command, **options):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, errors="replace", **options)


def build(work, tests):
    done = run(["cmake", "--build", work / "build", "--target", *tests])
    return done.returncode == 0, done.stdout + done.stderr


def failures(work, test, without=(), fast=True):
    """Names of the tests that fail in a program; the program's own where it ends without a word."""
    # One thread of the software renderer, as in the suite.
    environment = dict(os.environ, GTEST_FAIL_FAST="1" if fast else "0", GTEST_BRIEF="1", LP_NUM_THREADS="1")
    environment.pop("RC_PARAMS", None)  # the laws have a seed of their own, under which they hold
    try:
        done = run([work / "build/bin/tests" / test, ":".join([NOT_THE_HASH, *without])], env=environment, timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        return [f"{test} (did not end within {PATIENCE} s)"]
    failed = [l.split("]")[1].split(",")[0].split(" (")[0].strip()
              for l in done.stdout.split("\n") if l.startswith("[  FAILED  ]")]
    return sorted(set(failed)) or ([f"{test} (exit {done.returncode})"] if done.returncode else [])


def caught_by(work, tests, without):
    """The first test that fails, or nothing."""
    return next((f[0] for f in (failures(work, test, without) for test in tests) if f), None)


def check_texts(source, mutants):
    for m in mutants:
        count = (source / m["file"]).read_text().count(m["old"]) if (source / m["file"]).is_file() else 0
        if count != 1:
            sys.exit(f"mutants: {m['file']}: '{m['old']}' stands there {count} times, not once: "
                     f"the list needs to follow the code ({m['breaks']})")


def main():
    source, work = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    mutants = json.loads((pathlib.Path(__file__).parent / "mutants.json").read_text())
    check_texts(source, mutants)
    if sys.argv[3:] == ["--check"]:
        return print(f"{len(mutants)} faults, each with its place in the sources")
    mutants = [m for m in mutants if not sys.argv[3:] or any(t in m["file"] + m["breaks"] for t in sys.argv[3:])]
    copy = work / "source"
    copy_sources(source, copy)
    parts = {part for m in mutants for part in PARTS.get(folder_of(m["file"]), [])}
    configured = run(["cmake", "-S", copy, "-B", work / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
                      "-DGNOMON_TESTS=ON", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache",
                      # A write beyond a vector's end must not pass for luck.
                      "-DCMAKE_CXX_FLAGS=-O1 -D_GLIBCXX_ASSERTIONS",
                      *[f"-DGNOMON_{part}={'ON' if part in parts else 'OFF'}" for part in ALL_PARTS]])
    if configured.returncode != 0:
        sys.exit(configured.stdout + configured.stderr)
    tests = sorted({t for m in mutants for t in suite_of(m["file"])})
    good, log = build(work, tests)
    if not good:
        sys.exit("mutants: the sources do not build as they are:\n" + log[-4000:])
    # A random test may fail by its seed: it says nothing of a fault then, and is left out of this run.
    broken = [name for test in tests for name in failures(work, test, fast=False)]
    for name in broken:
        print(f"left out: {name} fails without any fault", flush=True)
    survivors = 0
    for number, m in enumerate(mutants, 1):
        file, begin = copy / m["file"], time.monotonic()
        text = file.read_text()
        file.write_text(text.replace(m["old"], m["new"]))
        try:
            good, log = build(work, suite_of(m["file"]))
            by = caught_by(work, suite_of(m["file"]), broken) if good else "the compiler"
        finally:
            file.write_text(text)
        survivors += by is None
        print(f"{number:2}/{len(mutants)} {'SURVIVED' if by is None else 'caught':8} {m['file']}: {m['breaks']}"
              f"{'' if by is None else ' | ' + by} ({time.monotonic() - begin:.0f} s)", flush=True)
    print(f"{len(mutants) - survivors} of {len(mutants)} faults caught")
    return 1 if survivors else 0


sys.exit(main())
