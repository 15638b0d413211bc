"""Do the examples print what they say? Those of the manual, and those of the pages that are named: examples.py PAGE..."""
import doctest
import importlib
import os
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
print("%d examples, %d fail" % (attempted, failed))
sys.exit(failed > 0)
