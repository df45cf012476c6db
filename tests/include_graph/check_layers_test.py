# SPDX-License-Identifier: BSD-3-Clause
"""Each rule of check_layers.py catches the breach it is there for, and lets the good tree pass."""
import tempfile
import unittest
from pathlib import Path

from check_layers import check

CMAKE = """
sslcd_module(core)
sslcd_module(io LINK core PRIVATE ${SSLCD_YAML_CPP})
sslcd_module(map LINK core)
sslcd_module(perception PRIVATE opencv_core)
  sslcd_module(optim LINK core map PRIVATE Ceres::ceres)
  add_subdirectory(src/sim)
  add_subdirectory(src/render)
"""
GOOD = {
    "CMakeLists.txt": CMAKE,
    "src/sim/CMakeLists.txt": "sslcd_room(sim LINK core map)\n",
    "src/render/CMakeLists.txt": "sslcd_room(render LINK sim)\n",
    "include/sslcd/core/pose.h": "#include <vector>\n#include <Eigen/Core>\n#include <lie/se3.h>\n",
    "include/sslcd/map/map.h": '#include <map>\n#include "sslcd/core/pose.h"\n',
    "include/sslcd/perception/opencv_image.h": "#include <opencv2/core.hpp>\n",
    "src/io/config.cc": '#include <yaml-cpp/yaml.h>\n#include "sslcd/core/pose.h"\n',
    "src/map/cells.h": "",
    "src/optim/ba.h": "#include <ceres/problem.h>\n",
    "src/optim/ba.cc": '#include "optim/ba.h"\n#include "sslcd/core/pose.h"\n#include "map/cells.h"\n',
    "src/sim/world.h": "",
    "src/sim/world.cc": '#include "sim/world.h"\n#include "sslcd/core/pose.h"\n#include "sslcd/map/map.h"\n',
    "src/render/view.h": "",
    "src/render/view.cc": '#include <embree3/rtcore.h>\n#include "sim/world.h"\n',
    "apps/CMakeLists.txt": "target_link_libraries(run PRIVATE sslcd_render_lib)\nsslcd_use_rooms(run optim)\n",
    "apps/run.cc": '#include "optim/ba.h"\n#include "sim/world.h"\n#include "sslcd/core/pose.h"\n',
    "tests/optim/CMakeLists.txt": "sslcd_test_module(optim LINK sslcd\n  PROPERTY A.*)\n",
    "tests/optim/ba_test.cc": '#include "map/cells.h"\n#include "optim/ba.h"\n',
    "tests/io/CMakeLists.txt": "sslcd_test_module(io LINK sslcd ROOMS map REGRESSION B.*)\n",
    "tests/io/config_test.cc": '#include "map/cells.h"\n',
}


class CheckLayers(unittest.TestCase):
    def breaches(self, changes):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in {**GOOD, **changes}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            return check(root)

    def expect_one(self, name, text, part):
        breaches = self.breaches({name: text})
        self.assertEqual(len(breaches), 1, breaches)
        self.assertIn(name, breaches[0])
        self.assertIn(part, breaches[0])

    def test_good_tree_passes(self):
        self.assertEqual(self.breaches({}), [])

    def test_lower_module_includes_higher(self):
        self.expect_one("src/core/pose.cc", '#include "sslcd/map/map.h"\n', "pose.cc:1: core does not link map")

    def test_module_not_in_the_link_list(self):
        self.expect_one("src/map/map.cc", '\n#include "sslcd/io/reader.h"\n', "no include/sslcd/io/reader.h")
        self.assertEqual(self.breaches({"include/sslcd/io/reader.h": "", "src/map/map.cc":
                                        '#include "sslcd/io/reader.h"\n'}),
                         ["src/map/map.cc:1: map does not link io"])

    def test_module_linked_only_through_another(self):
        cmake = CMAKE.replace("optim LINK core map", "optim LINK map")
        self.assertEqual(self.breaches({"CMakeLists.txt": cmake}), ["src/optim/ba.cc:2: optim does not link core"])

    def test_link_that_no_include_uses(self):
        self.expect_one("CMakeLists.txt", CMAKE.replace("optim LINK core", "optim LINK core io"),
                        "optim links io, which it does not include")
        self.expect_one("src/sim/CMakeLists.txt", "sslcd_room(sim LINK core io map)\n", "sim links io")
        self.expect_one("CMakeLists.txt", CMAKE.replace("Ceres::ceres", "Ceres::ceres FLANN::flann"), "links flann")

    def test_private_header_of_another_module(self):
        self.expect_one("src/map/map.cc", '#include "optim/ba.h"\n', "map does not link optim")
        self.expect_one("src/core/core.cc", '#include "map/cells.h"\n', "core does not link map")

    def test_outside_library_not_linked(self):
        self.expect_one("src/map/map.cc", "#include <ceres/problem.h>\n", "map does not link ceres")
        self.expect_one("src/optim/fit.cc", "#  include <flann/flann.hpp>\n", "optim does not link flann")
        self.expect_one("src/map/model.cc", "#include <onnxruntime_c_api.h>\n", "map does not link onnxruntime_c_api.h")

    def test_outside_library_shown_by_a_module_that_is_linked(self):
        cmake = CMAKE + "sslcd_module(fit LINK optim PRIVATE Ceres::ceres)\n"
        fit = {"CMakeLists.txt": cmake, "src/fit/fit.cc": '#include "optim/ba.h"\n'}
        self.assertEqual(self.breaches(fit), [])
        self.assertEqual(self.breaches({**fit, "src/optim/ba.h": "", "src/optim/solve.cc": "#include <ceres/problem.h>\n"}),
                         ["CMakeLists.txt: fit links ceres, which it does not include"])

    def test_public_header_shows_outside_library(self):
        self.expect_one("include/sslcd/optim/solve.h", "#include <ceres/problem.h>\n", "public header includes ceres")
        self.expect_one("include/sslcd/core/text.h", "#include <boost/any.hpp>\n", "boost/any.hpp")
        self.expect_one("include/sslcd/core/io.h", "#include <unistd.h>\n", "unistd.h")

    def test_public_header_includes_private(self):
        self.expect_one("include/sslcd/optim/solve.h", '#include "optim/ba.h"\n', "private")

    def test_library_does_not_see_what_is_above_it(self):
        self.expect_one("src/map/map.cc", '#include "sim/world.h"\n', "map does not link sim")
        later = CMAKE.replace("add_subdirectory(src/sim)", "")
        breaches = self.breaches({"CMakeLists.txt": "add_subdirectory(src/sim)\n" + later.replace(
            "optim LINK core", "optim LINK core sim"), "src/sim/CMakeLists.txt": "sslcd_room(sim)\n"})
        self.assertIn("CMakeLists.txt: optim links sim, which is not listed before it", breaches)

    def test_rooms_above_the_library_keep_their_order(self):
        self.expect_one("src/sim/a.cc", '#include "render/view.h"\n', "sim does not link render")

    def test_link_to_a_module_listed_later(self):
        self.expect_one("CMakeLists.txt", CMAKE.replace("(core)", "(core LINK optim)"), "core links optim")

    def test_folder_without_module(self):
        self.expect_one("src/extra/a.cc", "", "sslcd_module(extra")

    def test_program_includes_what_it_does_not_name(self):
        self.expect_one("tests/io/config_test.cc", '#include "map/cells.h"\n#include "optim/ba.h"\n',
                        "optim/ba.h is private to optim, which is not named")
        self.expect_one("bench/a.cc", '#include "map/cells.h"\n', "private to map")
        self.expect_one("bench/a.cc", '#include "map/other.h"\n', "there is no map/other.h")

    def test_program_names_what_it_does_not_include(self):
        self.expect_one("tests/io/CMakeLists.txt", "sslcd_test_module(io LINK sslcd ROOMS core map)\n", "core is named")
        self.expect_one("apps/CMakeLists.txt", "sslcd_render_lib\nsslcd_use_rooms(run map optim)\n", "map is named")

    def test_empty_tree_does_not_pass(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "CMakeLists.txt").write_text("")
            self.assertNotEqual(check(Path(folder)), [])


if __name__ == "__main__":
    unittest.main()
