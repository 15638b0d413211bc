# Do the pages hold together? Each link and each file that a page names leads somewhere, docs/README.md lists each page of docs,
# docs/architecture.md names the folders that are there, and docs/glossary.md explains each term once.
import os
import re

MAP = "docs/README.md"
# Words of README.md: it is read in two minutes.
LONGEST_FRONT_PAGE = 900
GLOSSARY = "docs/glossary.md"
ARCHITECTURE = "docs/architecture.md"
# Where files that pages name lie; and folders whose own folders docs/architecture.md must name.
FOLDERS = "cmake|docs|include|packaging|samples|shaders|src|tests"
NAMED_IN_FULL = ("include/gnomon", "src", "src/core", "src/render")


def without_code(text):
    return re.sub(r"```.*?```", lambda m: re.sub(r"[^\n]", " ", m.group(0)), text, flags=re.S)


def anchors_of(text):
    """What links to the headings of a page end in: small letters, no punctuation, - for a space."""
    anchors = set()
    for heading in re.findall(r"^#+ +(.*?) *$", without_code(text), re.M):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        anchors.add(re.sub(r"[^\w\- ]", "", heading).replace(" ", "-"))
    return anchors


def links_of(text):
    """(line, file, anchor) of each link to another file of the tree, or to a heading; either part may be empty."""
    text = without_code(text)
    for match in re.finditer(r"\]\(([^)\s#]*)(?:#([^)\s]*))?\)", text):
        if "://" not in match.group(1):
            yield text.count("\n", 0, match.start()) + 1, match.group(1), match.group(2) or ""


def faults_of_links(source, pages):
    texts = {}
    for page in pages:
        with open(os.path.join(source, page), encoding="utf-8") as file:
            texts[page] = file.read()
    for page in pages:
        for line, target, anchor in links_of(texts[page]):
            path = os.path.normpath(os.path.join(os.path.dirname(page), target)) if target else page
            if not os.path.exists(os.path.join(source, path)):
                yield "%s:%d: the link leads nowhere: %s" % (page, line, target)
            elif anchor and path in texts and anchor not in anchors_of(texts[path]):
                yield "%s:%d: %s has no heading #%s" % (page, line, path, anchor)
    if MAP in texts:
        linked = {os.path.normpath(os.path.join("docs", target)) for _, target, _ in links_of(texts[MAP]) if target}
        for page in pages:
            if os.path.dirname(page) == "docs" and page not in linked and page != MAP:
                yield "%s: no question leads to %s" % (MAP, page)


def faults_of_files(source, pages):
    """Files in backticks that are not there; where a page says how to add one, its line begins with Create or it is called NAME or FILTER."""
    for page in pages:
        with open(os.path.join(source, page), encoding="utf-8") as file:
            text = without_code(file.read())
        for number, line in enumerate(text.split("\n"), 1):
            for path in re.findall(r"`((?:%s)/[\w./]+)`" % FOLDERS, line):
                if not os.path.exists(os.path.join(source, path)) and not re.search("NAME|FILTER", path) and not line.startswith("Create"):
                    yield "%s:%d: there is no %s" % (page, number, path)


def folders_of(source, folder):
    path = os.path.join(source, folder)
    for name in sorted(os.listdir(path)) if os.path.isdir(path) else ():
        if os.path.isdir(os.path.join(path, name)):
            yield folder + "/" + name


def faults_of_folders(source):
    path = os.path.join(source, ARCHITECTURE)
    if not os.path.exists(path):
        return
    with open(path, encoding="utf-8") as file:
        text = file.read()
    named = set(re.findall(r"`((?:%s)/[\w./]+)`" % FOLDERS, text))
    for folder in NAMED_IN_FULL:
        for inner in folders_of(source, folder):
            if inner not in named:
                yield "%s: does not name the folder %s" % (ARCHITECTURE, inner)


def faults_of_glossary(source):
    path, first = os.path.join(source, GLOSSARY), {}
    if not os.path.exists(path):
        return
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            row = re.match(r"\| ([^|]+) \|", line)
            for term in row.group(1).split(", ") if row and row.group(1) != "term" else ():
                if term in first:
                    yield "%s:%d: line %d explains '%s' already" % (GLOSSARY, number, first[term], term)
                first.setdefault(term, number)


def faults_of_front_page(source):
    path = os.path.join(source, "README.md")
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            count = len(file.read().split())
        if count > LONGEST_FRONT_PAGE:
            yield "README.md: %d words, at most %d" % (count, LONGEST_FRONT_PAGE)
