# Which sentences are too long to be read in one go? In comments of public names and in pages.
import re

# Words of a sentence. Pages may state a command's figures in one sentence; cells of tables and code do not count.
LONGEST_IN_HEADERS = 25
LONGEST_IN_PAGES = 30


def blocks_of_header(text):
    """(line, text) of each comment of a public name, on as many lines as it has; items of lists and formulas by themselves."""
    blocks, open_block, trailing = [], False, False
    for number, line in enumerate(text.split("\n"), 1):
        match = re.match(r"(.*?)///(<?) ?(.*)$", line)
        alone = match and not match.group(1).strip()
        item = match and re.match(r"- |  ", match.group(3))
        goes_on = alone and open_block and (match.group(2) == "<") == trailing and match.group(3) and not item
        if goes_on:
            blocks[-1][1].append(match.group(3))
        elif match and match.group(3):
            blocks.append((number, [match.group(3)]))
        open_block = bool(match and match.group(3))
        trailing = bool(match and match.group(2))
    return [(number, " ".join(lines)) for number, lines in blocks]


def blocks_of_page(text):
    """(line, text) of each paragraph and item of a list; code spans are one word."""
    text = re.sub(r"```.*?```", lambda m: "\n" * (m.group(0).count("\n") + 1), text, flags=re.S)
    text = re.sub(r"`[^`]*`", lambda m: "code" + "\n" * m.group(0).count("\n"), text)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    blocks, open_block = [], False
    for number, line in enumerate(text.split("\n"), 1):
        line = line.strip()
        if not line or re.match(r"[#|]|!\[", line):
            open_block = False
            continue
        item = re.match(r"(?:[-*]|\d+\.)\s+(.*)", line)
        if item or not open_block:
            blocks.append((number, [item.group(1) if item else line]))
        else:
            blocks[-1][1].append(line)
        open_block = True
    return [(number, " ".join(lines)) for number, lines in blocks]


def faults_in(blocks, longest):
    for line, text in blocks:
        for sentence in re.split(r"(?<=[.?!])[\"')*\]]*\s+", text):
            count = len([word for word in sentence.split() if re.search(r"\w", word)])
            if count > longest:
                yield line, "a sentence of %d words, at most %d: '%s ...'" % (count, longest, " ".join(sentence.split()[:8]))
