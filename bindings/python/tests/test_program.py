"""Are masks of the program gnomon those of its scene? GNOMON_PROGRAM names it."""
import numpy as np
import pytest

import gnomon
from gnomon import GnomonError

SEEN = {"width": 160, "height": 90, "eye": (0, 3, 12), "target": (0, 1, 0)}


def test_exact_masks_and_those_of_filters_agree_but_at_edges():
    found = gnomon.masks("builtin:fence", ["hard", "pcf:radius=2"], cascades=2, map_size=1024, **SEEN)
    assert found.exact.shape == (90, 160) and found.exact.dtype == np.float32
    # Ground, shadow, and the sky above.
    assert set(np.unique(found.exact)) == {-1, 0, 1} and (found.exact[0] == -1).all() and (found.exact == 0).sum() > 300
    known = found.exact >= 0
    hard, soft = found.filters["hard"], found.filters["pcf:radius=2"]
    assert ((hard < 0) == (soft < 0)).all() and (hard[known] >= 0).all()
    wrong = np.abs(hard - found.exact)[known].mean()
    assert 0 < wrong < 0.05
    assert len(np.unique(soft)) > 10
    # Larger maps are nearer to the truth.
    coarse = gnomon.masks("builtin:fence", ["hard"], cascades=1, map_size=128, **SEEN)
    assert (coarse.exact == found.exact).all()
    assert np.abs(coarse.filters["hard"] - found.exact)[known].mean() > wrong


def test_what_the_program_refuses_is_told():
    def refused(*arguments, **options):
        with pytest.raises(GnomonError) as caught:
            gnomon.masks(*arguments, **options)
        return caught.value.field, str(caught.value)

    assert refused("no_file.glb")[0] == "scene" and "no_file.glb" in refused("no_file.glb")[1]
    assert "teapot" in refused("builtin:fence", ["teapot"], width=32, height=18)[1]
    assert "--size" in refused("builtin:fence", width=-1)[1]
    assert "cascade" in refused("builtin:fence", cascades=99)[1]
    # No shell reads a name.
    assert refused("$(touch x); builtin:fence")[0] == "scene"
    assert refused("builtin:fence", program="/no/gnomon")[0] == "program"
    assert refused("builtin:fence", eye=(0, 0, 0))[0] == "target"
    assert refused("builtin:fence", eye=(0, 0), target=(0, 0, 1))[0] == "eye"
