#!/usr/bin/env python3
"""check_layers.py must pass what is allowed and name what is not."""
import unittest

from check_project import run_check


def check(files):
    """Exit status and output of the check on a project made of these files."""
    return run_check("check_layers.py", files)


class CheckLayers(unittest.TestCase):
    def test_passes_what_the_order_allows(self):
        status, _ = check({
            "base/Error.h": "#include <string>",
            "radiosity/rays/Rays.cpp": '#include "radiosity/rays/Rays.h"\n#include "base/Error.h"\n'
                                       "#include <embree3/rtcore.h>",
            "radiosity/rays/Rays.h": "#include <glm/glm.hpp>",
            "radiosity/query/Gather.h": '#include "radiosity/rays/Rays.h"',
            "viewer/app/Window.cpp": '#include "io/image/Png.h"\n#include <epoxy/gl.h>',
            "tests/io/ExrTest.cpp": '#include "viewer/app/Window.h"\n#include <OpenEXR/ImfInputFile.h>',
        })
        self.assertEqual(status, 0)

    def fails_with(self, text, name, line):
        self.assertEqual(check({name: line}), (1, f"{name}: {text}"))

    def test_names_a_room_that_looks_up(self):
        self.fails_with("scenegraph/ may not include io/usd/layer/", "scenegraph/Node.h",
                        '#include "io/usd/layer/UsdText.h"')
        self.fails_with("radiosity/rows/ may not include radiosity/transport/", "radiosity/rows/Row.h",
                        '#include "radiosity/transport/Solver.h"')

    def test_keeps_io_and_radiosity_apart(self):
        self.fails_with("io/image/ may not include radiosity/mesh/", "io/image/Lit.cpp",
                        '#include "radiosity/mesh/PatchSet.h"')
        self.fails_with("radiosity/rows/ may not include io/image/", "radiosity/rows/Row.cpp",
                        '#include "io/image/Png.h"')

    def test_keeps_the_preview_below_the_window_and_opengl(self):
        self.fails_with("viewer/preview/ may not include viewer/gl/", "viewer/preview/LightFade.h",
                        '#include "viewer/gl/GlObject.h"')

    def test_keeps_tests_out_of_the_product(self):
        self.fails_with("tools/ may not include tests/viewer/", "tools/main.cpp",
                        '#include "tests/viewer/LitScenes.h"')

    def test_names_third_party_in_the_wrong_room(self):
        self.fails_with("only radiosity/rays/ may include <embree3/rtcore.h>", "scenegraph/Mesh.cpp",
                        "#include <embree3/rtcore.h>")

    def test_knows_a_library_with_two_homes(self):
        line = "#include <nlohmann/json.hpp>"
        self.assertEqual(check({"io/model/Json.cpp": line, "tools/Json.cpp": line})[0], 0)
        self.fails_with("only io/model/ and tools/ may include <nlohmann/json.hpp>", "io/image/Json.cpp", line)

    def test_names_third_party_in_a_header(self):
        self.fails_with("<epoxy/gl.h> belongs in a .cpp file", "viewer/gl/Texture.h",
                        "#include <epoxy/gl.h>")

    def test_wants_the_room_in_every_include(self):
        self.fails_with('"../io/Image.h" does not begin with a room of the project',
                        "scenegraph/Mesh.cpp", '#include "../io/Image.h"')

    def test_names_files_that_are_in_no_room(self):
        self.fails_with("radiosity/ is no room: see USES", "radiosity/Row.h", "#pragma once")

    def test_names_a_room_that_has_become_too_full(self):
        status, said = check({f"importance/File{i}.h": "#pragma once" for i in range(36)})
        self.assertEqual((status, said), (1, "importance/: 36 files are more than 35: "
                                             "is there a second idea in it?"))


if __name__ == "__main__":
    unittest.main()
