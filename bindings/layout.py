# Where do the fields of the C structs lie? Reads include/gnomon/c/gnomon.h, and writes the tables that bindings read:
#   layout.py            writes bindings/js/layout.js, bindings/python/src/gnomon/_layout.py and
#                        bindings/rust/gnomon-sys/src/header.rs
#   layout.py --check    1 where one of them is not what it would write
# A compiler of C confirms the sizes and offsets: tests/c/layout_test.py.
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
HEADER = os.path.join(HERE, "..", "include", "gnomon", "c", "gnomon.h")
JS = os.path.join(HERE, "js", "layout.js")
PYTHON = os.path.join(HERE, "python", "src", "gnomon", "_layout.py")
RUST = os.path.join(HERE, "rust", "gnomon-sys", "src", "header.rs")

# C type: name here, bytes.
SCALARS = {"int32_t": ("i32", 4), "uint32_t": ("u32", 4), "int64_t": ("i64", 8), "uint64_t": ("u64", 8),
           "float": ("f32", 4), "double": ("f64", 8), "uint8_t": ("u8", 1), "char": ("char", 1)}


def read_header():
    """The constants, of each struct its fields as (name, C type, pointer: const, mut, call or "", dimensions), of each call what it returns and
    its parameters as (name, C type), and the same of each pointer to a call of the caller's."""
    with open(HEADER, encoding="utf-8") as file:
        text = re.sub(r"//[^\n]*", "", file.read())
    constants = {}
    for body in re.findall(r"enum \{([^}]*)\}", text):
        for name, value in re.findall(r"(GNOMON_\w+) = (-?\d+)", body):
            constants[name] = int(value)
    # A pointer to a call of the caller's.
    callbacks = {name: (returns, parameters_of(parameters)) for returns, name, parameters in
                 re.findall(r"typedef (\w+) \(\*(gnomon_\w+)\)\(([^;]*)\);", text)}
    structs = {}
    for name, body in re.findall(r"typedef struct (gnomon_\w+) \{([^}]*)\} \1;", text):
        fields = []
        for declaration in filter(None, (part.strip() for part in body.split(";"))):
            constant, kind, names = re.match(r"(const )?(\w+)(\*?\s.*)$", declaration, re.S).groups()
            for one in names.split(","):
                pointer, field, dimensions = re.match(r"\s*(\*?)\s*(\w+)((?:\s*\[\w+\])*)$", one).groups()
                sizes = [constants.get(d) or int(d) for d in re.findall(r"\[(\w+)\]", dimensions)]
                fields.append((field, kind, "call" if kind in callbacks else pointer and ("const" if constant else "mut"), sizes))
        structs[name] = fields
    calls = {}
    for returns, name, parameters in re.findall(r"^(?:GNOMON_API|GNOMON_EXPERIMENTAL) ((?:const )?\w+\*?) (gnomon_\w+)\(([^;]*)\);", text, re.M):
        calls[name] = (returns, parameters_of(parameters))
    return constants, structs, calls, callbacks


def parameters_of(text):
    rows = []
    for one in ([] if text == "void" else text.split(",")):
        kind, parameter, array = re.match(r"\s*(.*?)\s*(\w+)(\[\w+\])?\s*$", one, re.S).groups()
        rows.append((parameter, kind.replace(" ", "") + ("*" if array else "")))
    return rows


def lay_out(structs, pointer_bytes):
    """Of each struct: (size, alignment, [(name, kind, offset, count)]); kind is a scalar, `ptr` or a struct's name."""
    done = {}
    for name, fields in structs.items():
        at, alignment, rows = 0, 1, []
        for field, kind, pointer, dimensions in fields:
            if pointer:
                kind, size, align = "ptr", pointer_bytes, pointer_bytes
            elif kind in SCALARS:
                kind, size = SCALARS[kind]
                align = size
            else:
                size, align = done[kind][0], done[kind][1]
            count = 1
            for dimension in dimensions:
                count *= dimension
            at = (at + align - 1) // align * align
            rows.append((field, kind, at, count if dimensions else 0))
            at += size * count
            alignment = max(alignment, align)
        done[name] = ((at + alignment - 1) // alignment * alignment, alignment, rows)
    return done


def short(name):
    return name.removeprefix("gnomon_")


def js_text(constants, structs):
    lines = ["// Where the fields of the C structs lie in the memory of the module. Written by bindings/layout.py.",
             "// [offset, kind, count]: count 0 is one value, else an array.", "export const structs = {"]
    for name, (size, _, rows) in lay_out(structs, 4).items():
        lines.append("  %s: {" % short(name))
        lines.append("    bytes: %d," % size)
        lines.append("    fields: {")
        for field, kind, offset, count in rows:
            lines.append("      %s: [%d, '%s', %d]," % (field, offset, short(kind), count))
        lines += ["    },", "  },"]
    lines += ["};", "", "export const constants = {"]
    lines += ["  %s: %d," % (name.removeprefix("GNOMON_"), value) for name, value in constants.items()]
    return "\n".join(lines + ["};", ""])


CTYPES = {"i32": "c_int32", "u32": "c_uint32", "i64": "c_int64", "u64": "c_uint64", "f32": "c_float", "f64": "c_double",
          "u8": "c_uint8", "char": "c_char", "ptr": "c_void_p"}


def python_kind(kind):
    """How ctypes passes a C type; None returns nothing."""
    if kind in SCALARS:
        return "ctypes." + CTYPES[SCALARS[kind][0]]
    if kind == "void":
        return "None"
    return "ctypes.c_char_p" if kind.replace(" ", "") == "constchar*" else "ctypes.c_void_p"


def python_annotation(kind, count):
    """What a field of ctypes is for who reads it."""
    if count:
        return "ctypes.Array[ctypes.%s]" % CTYPES[kind] if kind in CTYPES and kind != "char" else "Any"
    return {"f32": "float", "f64": "float", "ptr": "Any"}.get(kind, "int" if kind in CTYPES else short(kind))


def python_text(constants, structs, calls, callbacks):
    lines = ['"""The structs and constants of the C header. Written by bindings/layout.py."""', "from __future__ import annotations", "",
             "import ctypes", "from typing import Any", ""]
    lines += ["%s = %d" % (name.removeprefix("GNOMON_"), value) for name, value in constants.items()]
    for name, (returns, parameters) in callbacks.items():
        lines += ["", "%s: Any = ctypes.CFUNCTYPE(%s)" % (short(name), ", ".join(python_kind(kind) for kind in [returns] + [k for _, k in parameters]))]
    for name, (size, _, rows) in lay_out(structs, 8).items():
        lines += ["", "", "class %s(ctypes.Structure):" % short(name), "    _fields_ = ["]
        for field, kind, _, count in rows:
            kind = "ctypes." + CTYPES[kind] if kind in CTYPES else short(kind)
            lines.append('        ("%s", %s%s),' % (field, kind, " * %d" % count if count else ""))
        # For type checkers, which know nothing of _fields_.
        lines += ["    ]"] + ["    %s: %s" % (field, python_annotation(kind, count)) for field, kind, _, count in rows] + ["", "", "assert ctypes.sizeof(%s) == %d" % (short(name), size)]
    lines += ["", "# What each call returns, and its parameters.", "calls: dict[str, tuple[Any, list[tuple[str, Any]]]] = {"]
    for name, (returns, parameters) in calls.items():
        lines.append('    "%s": (%s, [%s]),' % (name, python_kind(returns), ", ".join('("%s", %s)' % (p, python_kind(k)) for p, k in parameters)))
    lines.append("}")
    return "\n".join(lines + [""])


def read_comments():
    """The text of each comment: by the name of the struct, constant or call, or by (struct, field)."""
    with open(HEADER, encoding="utf-8") as file:
        lines = file.read().split("\n")
    found, above, code, struct, named = {}, [], "", "", []
    for line in lines:
        before, _, text = line.partition("//")
        if before.strip():
            code = (code + " " + before.strip()).strip()
            opens = re.match(r"typedef struct (\w+) \{", code)
            declares = re.match(r"typedef (?:struct )?\w+ (?:\(\*)?(gnomon_\w+)(?:;|\))|(?:GNOMON_API|GNOMON_EXPERIMENTAL) .*?(gnomon_\w+)\(", code)
            if opens:
                struct = opens.group(1)
                named = [struct]
            elif declares:
                named = [declares.group(1) or declares.group(2)]
            elif code.startswith("}"):
                struct, named = "", []
            elif struct and code.endswith(";"):
                named = [(struct, re.findall(r"\w+", one)[-1]) for one in re.sub(r"\[\w+\]", "", code[:-1]).split(",")]
            else:
                named = re.findall(r"^(GNOMON_\w+) = ", code)
            if code.endswith((";", "{", "}", ",")) or not struct:
                code = ""
            for name in named:
                found.setdefault(name, []).extend(above)
            above = above if code else []
        if text.startswith("/<"):
            for name in named:
                found[name].append(text[2:].strip())
        elif not before.strip():
            above = above + [text[1:].strip()] if text.startswith("/") and not text.startswith("/     ") else above if text else []
    return {name: " ".join(filter(None, words)) for name, words in found.items()}


RUST_TYPES = {"i32": "i32", "u32": "u32", "i64": "i64", "u64": "u64", "f32": "f32", "f64": "f64", "u8": "u8", "char": "c_char"}


def rust_type(kind):
    return "core::ffi::c_void" if kind == "void" else RUST_TYPES[SCALARS[kind][0]] if kind in SCALARS else kind


def rust_kind(kind):
    """The type of a parameter or result."""
    kind = kind.replace(" ", "")
    if kind == "void":
        return ""
    stars = []
    # From the right: each star points to what stands left of it.
    while kind.endswith("*"):
        kind = kind[:-1]
        constant = kind.startswith("const") and kind.count("*") == 0
        if kind.endswith("const"):
            kind, constant = kind[:-5], True
        stars.append("*const " if constant else "*mut ")
    kind = kind.removeprefix("const")
    return "".join(stars) + rust_type(kind)


def rust_parameters(rows):
    return ", ".join("%s: %s" % ("r#box" if parameter == "box" else parameter, rust_kind(kind)) for parameter, kind in rows)


def rust_text(constants, structs, calls, callbacks):
    comments = read_comments()

    def comment(name, indent=""):
        text = comments.get(name, "").replace("[", "\\[").replace("]", "\\]")
        return [indent + "/// " + text] if text else []

    lines = ["// The structs, constants and calls of include/gnomon/c/gnomon.h. Written by bindings/layout.py.", ""]
    for name, value in constants.items():
        lines += comment(name) + ["pub const %s: i32 = %d;" % (name, value)]
    handles = {kind for _, rows in calls.values() for _, kind in rows for kind in re.findall(r"gnomon_\w+", kind)} - set(structs)
    for name in sorted(handles):
        lines += [""] + comment(name) + ["#[repr(C)]", "pub struct %s {" % name, "    hidden: [u8; 0],",
                  "    not_send: core::marker::PhantomData<*mut u8>,", "}"]
    for name, (returns, rows) in callbacks.items():
        lines += [""] + comment(name) + ['pub type %s = Option<unsafe extern "C" fn(%s) -> %s>;' % (name, rust_parameters(rows), rust_kind(returns))]
    for name, fields in structs.items():
        lines += [""] + comment(name) + ["#[repr(C)]", "#[derive(Clone, Copy, Debug)]", "pub struct %s {" % name]
        for field, kind, pointer, dimensions in fields:
            kind = rust_type(kind)
            kind = "*%s %s" % (pointer, kind) if pointer in ("const", "mut") else kind
            for size in reversed(dimensions):
                kind = "[%s; %d]" % (kind, size)
            lines += comment((name, field), "    ") + ["    pub %s: %s," % (field, kind)]
        lines.append("}")
    lines += ["", 'extern "C" {']
    for name, (returns, rows) in calls.items():
        given = rust_parameters(rows)
        result = rust_kind(returns)
        lines += comment(name, "    ") + ["    pub fn %s(%s)%s;" % (name, given, " -> " + result if result else "")]
    lines += ["}", "", "// Each struct's size, and where its fields lie, as the compiler of C has them (tests/c/layout_test.py).",
              '#[cfg(all(test, target_pointer_width = "64"))]', "macro_rules! each_layout {", "    ($check:ident) => {"]
    for name, (size, _, rows) in lay_out(structs, 8).items():
        lines.append("        $check!(%s, %d, %s);" % (name, size, ", ".join("%s: %d" % (field, offset) for field, _, offset, _ in rows)))
    return "\n".join(lines + ["    };", "}", ""])


def main():
    constants, structs, calls, callbacks = read_header()
    if len(structs) < 20 or len(constants) < 80 or len(calls) < 60:
        sys.exit("the header's structs and calls were not found")
    stale = []
    for path, text in ((JS, js_text(constants, structs)), (PYTHON, python_text(constants, structs, calls, callbacks)),
                       (RUST, rust_text(constants, structs, calls, callbacks))):
        if not os.path.isdir(os.path.dirname(path)):
            continue
        old = open(path, encoding="utf-8").read() if os.path.exists(path) else ""
        if old == text:
            continue
        stale.append(os.path.relpath(path, os.path.join(HERE, "..")))
        if "--check" not in sys.argv:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
    if stale and "--check" in sys.argv:
        sys.exit("not what include/gnomon/c/gnomon.h has; run python3 bindings/layout.py: %s" % ", ".join(stale))


if __name__ == "__main__":
    main()
