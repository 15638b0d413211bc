"""Do the examples print what they say? Those of the manual, and those of the pages that are named: examples.py PAGE... And do those
of the front page and of the package's page run as they stand?"""
import doctest
import importlib
import os
import re
import sys

import matplotlib

import gnomon

matplotlib.use("Agg")
attempted = failed = 0
for name in ("gnomon", *("gnomon." + file[:-3] for file in sorted(os.listdir(os.path.dirname(gnomon.__file__))) if file.startswith("_") and file.endswith(".py") and not file.startswith("__"))):
    found = doctest.testmod(importlib.import_module(name), extraglobs={one: getattr(gnomon, one) for one in gnomon.__all__})
    attempted, failed = attempted + found.attempted, failed + found.failed
assert attempted > 40, attempted
for page in sys.argv[1:]:
    with open(page, encoding="utf-8") as file:
        # A fence would count as what the example prints.
        text = "".join("\n" if line.startswith("```") else line for line in file)
    test = doctest.DocTestParser().get_doctest(text, {}, page, page, 0)
    assert len(test.examples) > 20, page
    found = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test)
    attempted, failed = attempted + found.attempted, failed + found.failed
for page in ("../../../README.md", "../README.md"):
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), page), encoding="utf-8") as file:
        blocks = re.findall(r"^```python\n(.*?)^```$", file.read(), re.MULTILINE | re.DOTALL)
    assert blocks, page
    for block in blocks:
        drawn: list[tuple[object, ...]] = []
        boxes = [[-40, -1, -200, 40, 0, 20], [-4, 0, -30, 4, 6, -26]]
        given = {"eye": (0, 3, 10), "forward": (0, -0.1, -1), "sun": (0.4, -1, 0.3), "casters": boxes, "receivers": boxes}
        exec(compile(block, page, "exec"), {**given, "draw": lambda *one: drawn.append(one)})
        assert len(drawn) > 1 or "draw(" not in block, page
        attempted += 1
print("%d examples, %d fail" % (attempted, failed))
sys.exit(failed > 0)
