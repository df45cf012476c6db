# SPDX-License-Identifier: BSD-3-Clause
"""Each rule of check_layers.py catches the breach it is there for, and lets the good tree pass."""
import tempfile
import unittest
from pathlib import Path

from check_layers import check

CMAKE = """
sslcd_module(core  LINK sslcd_lie)
sslcd_module(io    LINK sslcd_core PRIVATE ${SSLCD_YAML_CPP})
sslcd_module(map   LINK sslcd_core)
sslcd_module(optim LINK sslcd_map  PRIVATE Ceres::ceres)
"""
GOOD = {
    "CMakeLists.txt": CMAKE,
    "include/sslcd/core/pose.h": "#include <vector>\n#include <Eigen/Core>\n#include <lie/se3.h>\n",
    "include/sslcd/map/map.h": '#include <map>\n#include "sslcd/core/pose.h"\n',
    "include/sslcd/optim/cost_functors.h": "#include <ceres/jet.h>\n",
    "src/io/config.cc": '#include <yaml-cpp/yaml.h>\n#include "sslcd/core/pose.h"\n',
    "src/optim/ba.h": "#include <ceres/problem.h>\n",
    "src/optim/ba.cc": '#include "optim/ba.h"\n#include "sslcd/core/pose.h"\n',  # core through map
    "src/sim/world.cc": '#include "sslcd/map/map.h"\n',
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
        self.expect_one("src/core/pose.cc", '#include "sslcd/map/map.h"\n', "pose.cc:1: core is not above map")

    def test_module_not_in_the_link_list(self):
        self.expect_one("src/map/map.cc", '\n#include "sslcd/io/reader.h"\n', "no include/sslcd/io/reader.h")
        self.assertEqual(self.breaches({"include/sslcd/io/reader.h": "", "src/map/map.cc":
                                        '#include "sslcd/io/reader.h"\n'}), ["src/map/map.cc:1: map is not above io"])

    def test_private_header_of_another_module(self):
        self.expect_one("src/map/map.cc", '#include "optim/ba.h"\n', "private to optim, which map does not link")
        self.expect_one("src/core/core.cc", '#include "map/cells.h"\n', "private to map")
        self.assertEqual(self.breaches({"src/optim/ba.cc": '#include "map/cells.h"\n'}), [])

    def test_outside_library_not_linked(self):
        self.expect_one("src/map/map.cc", "#include <ceres/problem.h>\n", "map does not link ceres")
        self.expect_one("src/optim/fit.cc", "#  include <flann/flann.hpp>\n", "optim does not link flann")
        self.expect_one("src/map/model.cc", "#include <onnxruntime_c_api.h>\n", "map does not link onnxruntime_c_api.h")

    def test_files_left_out_are_no_libraries(self):
        cmake = CMAKE.replace("sslcd_module(map   LINK sslcd_core)", "sslcd_module(map LINK sslcd_core WITHOUT ceres.cc)")
        breaches = self.breaches({"CMakeLists.txt": cmake, "src/map/map.cc": "#include <ceres/problem.h>\n"})
        self.assertEqual(breaches, ["src/map/map.cc:1: map does not link ceres"])

    def test_public_header_shows_outside_library(self):
        self.expect_one("include/sslcd/optim/solve.h", "#include <ceres/problem.h>\n", "public header includes ceres")
        self.expect_one("include/sslcd/core/text.h", "#include <boost/any.hpp>\n", "boost/any.hpp")
        self.expect_one("include/sslcd/core/io.h", "#include <unistd.h>\n", "unistd.h")

    def test_public_header_includes_private(self):
        self.expect_one("include/sslcd/optim/solve.h", '#include "optim/ba.h"\n', "private")

    def test_library_includes_sim(self):
        breaches = self.breaches({"src/map/map.cc": '#include "sim/world.h"\n'})
        self.assertEqual(breaches, ["src/map/map.cc:1: sim/world.h is private to sim, which map does not link"])

    def test_sim_and_baselines_stand_side_by_side(self):
        self.assertEqual(self.breaches({"src/baselines/other.cc": '#include "sslcd/map/map.h"\n'}), [])
        self.expect_one("src/baselines/other.cc", '#include "sim/world.h"\n', "private to sim, which baselines does not")

    def test_render_stands_on_sim(self):
        self.assertEqual(self.breaches({"src/render/view.cc":
                                        '#include <embree3/rtcore.h>\n#include "sim/world.h"\n'}), [])
        self.expect_one("src/sim/a.cc", '#include "render/view.h"\n', "private to render, which sim does not link")

    def test_link_to_a_module_listed_later(self):
        wrong = CMAKE.replace("core  LINK sslcd_lie", "core  LINK sslcd_optim")
        self.expect_one("CMakeLists.txt", wrong, "core links sslcd_optim")

    def test_folder_without_module(self):
        self.expect_one("src/extra/a.cc", "", "no sslcd_module(extra")

    def test_empty_tree_does_not_pass(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "CMakeLists.txt").write_text("")
            self.assertNotEqual(check(Path(folder)), [])


if __name__ == "__main__":
    unittest.main()
