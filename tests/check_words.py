#!/usr/bin/env python3
"""Checks that no identifier uses a word that docs/architecture.md replaced. Usage: check_words.py [PROJECT_ROOT]

Comments, strings and documents are read by people; only identifiers are checked here."""
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
NO_CODE = re.compile(r'R"(\w*)\((?:.|\n)*?\)\1"|//[^\n]*|/\*(?:.|\n)*?\*/|#include[^\n]*|"(?:\\.|[^"\\\n])*"|'
                     r"'(?:\\.|[^'\\\n])+'")
IDENTIFIER = re.compile(r"\b[A-Za-z_]\w*\b")


def faults(root):
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in {".h", ".cpp"}:
                continue
            text = path.read_text(encoding="utf-8")
            code = NO_CODE.sub(lambda found: "\n" * found.group(0).count("\n"), text)
            for number, line in enumerate(code.split("\n"), 1):
                for name in IDENTIFIER.findall(line):
                    for pattern, instead in REPLACED:
                        if re.search(pattern, name):
                            yield f"{path.relative_to(root).as_posix()}:{number}: {name}: write {instead}"


if __name__ == "__main__":
    found = list(faults(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) or "words: no identifier uses a word that was replaced")
    sys.exit(1 if found else 0)
