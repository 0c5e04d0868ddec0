#!/usr/bin/env python3
"""check_layers.py must pass what is allowed and name what is not."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).with_name("check_layers.py")


def check(files):
    """Exit status and output of the check on a project made of these files."""
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = pathlib.Path(root, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text + "\n", encoding="utf-8")
        done = subprocess.run([sys.executable, CHECK, root], capture_output=True, text=True)
        return done.returncode, done.stdout.strip()


class CheckLayers(unittest.TestCase):
    def test_passes_what_the_order_allows(self):
        status, _ = check({
            "scenegraph/Error.h": "#include <string>",
            "radiosity/Rays.cpp": '#include "radiosity/Rays.h"\n#include "scenegraph/Error.h"\n'
                                  "#include <embree3/rtcore.h>",
            "radiosity/Rays.h": "#include <glm/glm.hpp>",
            "viewer/Window.cpp": '#include "io/Image.h"\n#include <epoxy/gl.h>',
            "tests/io/ExrTest.cpp": '#include "viewer/Window.h"\n#include <OpenEXR/ImfInputFile.h>',
        })
        self.assertEqual(status, 0)

    def fails_with(self, text, name, line):
        self.assertEqual(check({name: line}), (1, f"{name}: {text}"))

    def test_names_a_folder_that_looks_up(self):
        self.fails_with("scenegraph/ may not include io/", "scenegraph/Error.h",
                        '#include "io/UsdText.h"')

    def test_keeps_io_and_radiosity_apart(self):
        self.fails_with("io/ may not include radiosity/", "io/Lit.cpp",
                        '#include "radiosity/PatchSet.h"')
        self.fails_with("radiosity/ may not include io/", "radiosity/Row.cpp", '#include "io/Image.h"')

    def test_keeps_tests_out_of_the_product(self):
        self.fails_with("tools/ may not include tests/", "tools/main.cpp",
                        '#include "tests/viewer/LitScenes.h"')

    def test_names_third_party_in_the_wrong_folder(self):
        self.fails_with("only radiosity/ may include <embree3/rtcore.h>", "scenegraph/Picking.cpp",
                        "#include <embree3/rtcore.h>")

    def test_names_third_party_in_a_header(self):
        self.fails_with("<epoxy/gl.h> belongs in a .cpp file", "viewer/Texture.h",
                        "#include <epoxy/gl.h>")

    def test_wants_the_folder_in_every_include(self):
        self.fails_with('"../io/Image.h" does not begin with a folder of the project',
                        "scenegraph/Mesh.cpp", '#include "../io/Image.h"')


if __name__ == "__main__":
    unittest.main()
