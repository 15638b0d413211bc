# Does each `Type::member` that a comment or a page names exist? One that was renamed stays behind in comments.
import os
import re

# GLSL has blocks in place of classes.
TYPE = re.compile(r"\b(?:struct|class|union|enum(?:\s+class|\s+struct)?|buffer|uniform)\s+(?:GNOMON_\w+\s+)?([A-Z]\w*)\s*(?:final\s*)?(?::([^;{()]*))?\{")
NAMED = re.compile(r"\b([A-Z]\w*)::(?=(~?\w+))")
BRACE = re.compile(r"[{}]")
# Code of a language that writes the names of its own types so.
RUST = re.compile(r"^```rust$.*?^```$", re.S | re.M)
# Names of other libraries.
FOREIGN = ("CLI", "Json", "Ogre", "ShadowSettings")


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"", " ", text, flags=re.S)


def comments_of(text):
    """As many characters and line ends, and comments alone."""
    parts = re.split(r"(//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\")", text, flags=re.S)
    return "".join(part if part.startswith("/") else re.sub(r"[^\n]", " ", part) for part in parts)


def body_at(text, begin):
    """What stands between the brace at `begin` and the one that closes it."""
    depth = 0
    for brace in BRACE.finditer(text, begin):
        depth += 1 if brace.group(0) == "{" else -1
        if depth == 0:
            return text[begin + 1:brace.start()]
    return text[begin + 1:]


def members_of_types(texts, registries):
    """By the name of a type: every word in its body. `registries`: what a .def file lists, by its path."""
    members, bases = {}, {}
    for text in texts:
        registered = re.findall(r"#\s*include\s+\"([\w/]+\.def)\"", text)
        text = without_comments(text)
        for match in TYPE.finditer(text):
            name, body = match.group(1), body_at(text, match.end() - 1)
            words = members.setdefault(name, set())
            words.update(re.findall(r"\w+", body))
            if re.search(r"#\s*include", body):
                for path in registered:
                    words.update(registries.get(path, ()))
            bases.setdefault(name, set()).update(re.findall(r"\b[A-Z]\w*", match.group(2) or ""))
        for alias, of in re.findall(r"\busing\s+([A-Z]\w*)\s*=\s*(?:\w+::)*([A-Z]\w*)", text):
            bases.setdefault(alias, set()).add(of)
    for name, own in bases.items():
        for base in own:
            members.setdefault(name, set()).update(members.get(base, ()))
    return members


def faults_in(text, members):
    """(line, fault) of each name in `text`, which holds comments alone or is a page, that no type has."""
    text = RUST.sub(lambda code: re.sub(r"[^\n]", " ", code.group()), text)
    for match in NAMED.finditer(text):
        kind, member = match.group(1), match.group(2)
        if kind in FOREIGN:
            continue
        if kind not in members:
            yield text.count("\n", 0, match.start()) + 1, "'%s::%s': there is no type %s" % (kind, member, kind)
        elif member.lstrip("~") not in members[kind] and member != kind:
            yield text.count("\n", 0, match.start()) + 1, "'%s::%s': %s has no such member" % (kind, member, kind)
