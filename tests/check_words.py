#!/usr/bin/env python3
"""Checks that nothing uses a word that docs/architecture.md replaced. Usage: check_words.py [PROJECT_ROOT]

Identifiers are checked for all of them. Comments, strings and documents are checked for those that have no other
meaning in plain English: a thing may stand on a table, and a person may look at it."""
import pathlib
import re
import sys

FOLDERS = ["base", "scenegraph", "importance", "radiosity", "io", "comparison", "viewer", "tools", "bench", "tests"]
# What an identifier may not be or contain, and what is written instead.
REPLACED = [
    (r"(?<![cC])[lL]amp", "light (in the scene), emitter (in the solver)"),
    (r"\bOpenWork|\bopenWork|\bOpenBlock\b|\bOpenGroups", "dirty set, dirty block"),
    (r"putOff|PutOff", "deferred"),
    (r"OrderOfWork|UpdateOrder|WorkOrder", "scheduling policy"),
    (r"\bWorth|\bworth|Worth\b|WorkValue|workValue|\bPlaceValue|\bplaceValue", "priority"),
    (r"Prospect|prospect", "partial update"),
    (r"VertexPlaces|PlaceClusters|WorkPlace", "receiver cluster"),
    (r"SeenWork", "view priority"),
    (r"LocalShare", "kernel estimate"),
    (r"[aA]rrangement", "scene state"),
    (r"\bLive[A-Z]|\blive[A-Z]|\blive_?\b|LiveBy", "preview"),
    (r"setOut|SetOut|SetsOut", "fade"),
    (r"ShiningMesh|\bshines\b|\bshining", "emissive mesh, emits"),
    (r"StandingPatches|\bstanding_?\b", "posed"),
    (r"Graph(Table|Image|Copy)", "scene difference, snapshot, replica"),
    (r"[pP]atience", "aging"),
    (r"\btold\b|otherSide", "reported, notified, worker"),
    (r"ChangeLook|\blooks\b|nextLook|lookClosely", "probe, search, sample"),
]
# What comments, strings and documents may not say, in any case and over the ends of lines.
PHRASES = [
    ("open work", "dirty set, dirty blocks"),
    ("(put|puts|putting) off", "deferred"),
    ("orders? of work", "scheduling policy"),
    ("(worth|value) of work", "priority"),
    ("the other side", "worker, peer"),
    ("patience", "aging"),
    ("live (lamps?|lights?)", "previewed lights"),
    ("drawn live", "previewed"),
    ("arrangements?", "scene state"),
    ("(set|sets) out", "begins to fade"),
    ("(meshes that shine|shining mesh(es)?)", "emissive mesh"),
    ("graph (image|table|copy)", "scene snapshot, difference, replica"),
]
# In C++ alone: documents also speak of desk lamps. Paths of prims and names of files are no words.
LAMP = (r"(?<![\w/\-\"])lamps?(?![\w/-]|\.\w)", "light (in the scene), emitter (in the solver)")
NO_CODE = re.compile(r'R"(\w*)\((?:.|\n)*?\)\1"|//[^\n]*|/\*(?:.|\n)*?\*/|#include[^\n]*|"(?:\\.|[^"\\\n])*"|'
                     r"'(?:\\.|[^'\\\n])+'")
IDENTIFIER = re.compile(r"\b[A-Za-z_]\w*\b")


def spoken(pattern):
    """The pattern with gaps that also match where a comment or a string goes on in the next line."""
    return re.compile(r"\b" + pattern.replace(" ", r"(?:\s|//+<?|\")+") + r"\b", re.IGNORECASE)


PROSE = [(spoken(pattern), instead) for pattern, instead in PHRASES]
PROSE_OF_CODE = [*PROSE, (re.compile(LAMP[0], re.IGNORECASE), LAMP[1])]


def prose_faults(name, text, patterns):
    for pattern, instead in patterns:
        for found in pattern.finditer(text):
            words = " ".join(re.sub(r'//+<?|"', " ", found.group(0)).split())
            yield f"{name}:{text.count(chr(10), 0, found.start()) + 1}: {words}: write {instead}"


def only_prose(text):
    """Comments and strings of C++ where they were; blanks instead of code and of what is included."""
    kept, end = [], 0
    for found in NO_CODE.finditer(text):
        kept.append(re.sub(r"[^\s]", " ", text[end:found.start()]))
        part = found.group(0)
        kept.append(re.sub(r"[^\s]", " ", part) if part.startswith(("#include", "'")) else part)
        end = found.end()
    return "".join(kept)


def shader_of(found):
    """The text of a shader, which has identifiers as C++ has; of no other string."""
    text = found.group(0)
    shader = text.startswith('R"') and re.search(r"\b(void main|uniform (int|float|vec\d|mat\d)|vec\d)\b", text)
    return re.sub(r"//[^\n]*", "", text) if shader else None


def only_sentences(name, text):
    """A document without the table of terms, which has the replaced words in its last column."""
    if name != "docs/architecture.md":
        return text
    return re.sub(r"\n## Words\n.*?(?=\n## )", lambda found: "\n" * found.group(0).count("\n"), text,
                  flags=re.DOTALL)


def faults_of_documents(root):
    for path in sorted([*root.glob("*.md"), *root.glob("docs/*.md"), *root.glob("scenes/*.md")]):
        name = path.relative_to(root).as_posix()
        yield from prose_faults(name, only_sentences(name, path.read_text(encoding="utf-8")), PROSE)


def faults(root):
    yield from faults_of_documents(root)
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in {".h", ".cpp"}:
                continue
            text = path.read_text(encoding="utf-8")
            yield from prose_faults(path.relative_to(root).as_posix(), only_prose(text), PROSE_OF_CODE)
            code = NO_CODE.sub(lambda found: shader_of(found) or "\n" * found.group(0).count("\n"), text)
            for number, line in enumerate(code.split("\n"), 1):
                for name in IDENTIFIER.findall(line):
                    for pattern, instead in REPLACED:
                        if re.search(pattern, name):
                            yield f"{path.relative_to(root).as_posix()}:{number}: {name}: write {instead}"


if __name__ == "__main__":
    found = list(faults(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) or "words: nothing uses a word that was replaced")
    sys.exit(1 if found else 0)
