"""Do the captures of Filament's LiSPSM follow its formulas, and does gnomon find nothing wrong with their maps?

    filament_test.py PROJECT GNOMON
"""
import importlib.util
import json
import math
import pathlib
import subprocess
import sys
import tempfile

project, program = pathlib.Path(sys.argv[1]), sys.argv[2]
spec = importlib.util.spec_from_file_location("filament", project / "samples/capture/filament.py")
filament = importlib.util.module_from_spec(spec)
spec.loader.exec_module(filament)
shipped = sorted((project / "samples/capture/filament").glob("*.json"))
assert len(shipped) == 8, shipped


def near_distance_without_hints_is_that_of_the_paper():
    """Reference values of an independent implementation: (near + sqrt(near end)) / sin."""
    golden = json.loads((project / "tests/data/golden/lispsm.json").read_text())
    compared = 0
    for config in golden["configs"]:
        fit = next(f for f in config["fits"] if f["mode"] == "uniform")
        wanted = fit["n_candidates"]["shaderx4"]
        near, far, sine = fit["zn_eff"], fit["zf_eff"], fit["sin_gamma"]
        # Filament's end is the nearer of the body's far depth and of near + d sin, which is the paper's.
        if not isinstance(wanted, float) or sine <= filament.LEAST_SINE or far < (1.0 - 1e-9) * (near + fit["d"] * sine):
            continue
        made = filament.near_distance(sine, near, far, fit["d"], near, far, near_hint=0.0, far_hint=math.inf)
        assert abs(made / wanted - 1.0) < 1e-9, (config["name"], made, wanted)
        compared += 1
    assert compared == 4, compared


def near_hint_moves_the_centre_away_until_nothing_is_warped():
    last = 0.0
    for hint in (0.0, 1.0, 5.0, 20.0, 60.0):
        distance = filament.near_distance(1.0, 1.0, 100.0, 99.0, 1.0, 100.0, near_hint=hint)
        assert distance >= last, (hint, distance, last)
        last = distance
    assert filament.near_distance(1.0, 1.0, 100.0, 99.0, 1.0, 100.0, near_hint=67.5) is None, "two thirds of the depths"
    assert filament.near_distance(0.01, 1.0, 100.0, 99.0, 1.0, 100.0) is None, "the light along the view"


def maps_keep_rays_and_hold_the_body(file):
    capture = json.loads(file.read_text())
    light = filament.unit(capture["lights"][0]["direction"])
    for frame in capture["frames"]:
        m = filament.rows_of(frame["maps"][0]["clip_from_world"])
        size = frame["maps"][0]["width"]
        made, body = filament.map_of(filament.Eye(frame["camera"]), light, capture["casters"][0], capture["receivers"][0], size)
        most = [0.0, 0.0]
        for point in body:
            at, w = filament.image(m, point)
            assert w > 0.0 and -1.0 - 1e-6 <= at[2] <= 1.0 + 1e-6, (file.name, at, w)
            behind, _ = filament.image(m, [p + 0.01 * d for p, d in zip(point, light)])
            assert max(abs(behind[i] - at[i]) for i in range(2)) < 1e-6, "a ray of light is a point of the map"
            assert behind[2] > at[2], "depth grows along the light"
            most = [max(most[i], abs(at[i])) for i in range(2)]
        inside = 1.0 - 2.0 * filament.BORDER / size
        assert all(abs(side - inside) < 1e-6 for side in most), (file.name, most)


def judge_finds_nothing_but_what_lispsm_is_known_for(file):
    done = subprocess.run([program, "judge", str(file), "--json"], capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr
    kinds = {finding["kind"] for line in done.stdout.splitlines() for finding in json.loads(line)["findings"]}
    # No bias is captured, and a fit of each frame moves its texels.
    assert kinds <= {"bias_small", "swimming", "density_jump", "texels_unseen"}, (file.name, kinds)


def gnomon_and_the_script_make_a_shipped_capture_again():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "compare", "builtin:fence", "--near", "0.1", "--filters", "hard", "--warps", "none",
                        "--cascades", "1", "--map-sizes", "64", "--frames", "1", "--rounds", "1", "--size", "240x135",
                        "--pixel-samples", "1", "--context", "osmesa", "--write-masks", "--exact", "none",
                        "--out", folder + "/out"], check=True, capture_output=True)
        subprocess.run([sys.executable, str(project / "samples/capture/filament.py"),
                        folder + "/out/masks/technique0/masks.jsonl", folder, "256"], check=True, capture_output=True)
        made = json.loads(pathlib.Path(folder, "fence_38_near_0.1.json").read_text())
    kept = json.loads((project / "samples/capture/filament/fence_38_near_0.1.json").read_text())
    assert len(made["frames"]) == len(kept["frames"]) == 2
    for a, b in zip(made["frames"], kept["frames"]):
        for key in ("view_from_world", "clip_from_view"):
            assert all(abs(x - y) < 1e-9 for x, y in zip(a["camera"][key], b["camera"][key]))
        assert all(abs(x - y) < 1e-9 for x, y in zip(a["maps"][0]["clip_from_world"], b["maps"][0]["clip_from_world"]))


near_distance_without_hints_is_that_of_the_paper()
near_hint_moves_the_centre_away_until_nothing_is_warped()
for capture_file in shipped:
    maps_keep_rays_and_hold_the_body(capture_file)
    judge_finds_nothing_but_what_lispsm_is_known_for(capture_file)
gnomon_and_the_script_make_a_shipped_capture_again()
print("%d captures hold" % len(shipped))
