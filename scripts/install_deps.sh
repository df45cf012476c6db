#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what sslcd needs, with apt, on Debian 12 and 13 and Ubuntu 24.04. Does not run apt if
# nothing is missing.
#   scripts/install_deps.sh [build|python|vision|test|dev|fuzz]
#     build   the library and the tools; enough for scripts/demo.sh
#     python  and what `pip install .` needs
#     vision  and ONNX Runtime, to run models (docs/models.md), before or after the build; all else is
#             installed where that cannot be had
#     test    and what the tests need, with clang-format, Embree for sslcd_sim --render, pybind11 and
#             NumPy for the Python package, Dask for its fleets, ROS 1 for sslcd_node, Chromium for
#             reports, and MkDocs (default)
#     dev     and clang-tidy, Doxygen, Google Benchmark, mypy and Shapely
#     fuzz    build, and clang with libFuzzer, for scripts/fuzz.sh
set -euo pipefail

build=(build-essential cmake ninja-build ccache libeigen3-dev libceres-dev libflann-dev liblz4-dev
       libyaml-cpp-dev libpugixml-dev libsqlite3-dev nlohmann-json3-dev libcli11-dev libspdlog-dev
       libopencv-core-dev libopencv-imgcodecs-dev libopencv-imgproc-dev libopencv-video-dev
       libopencv-features2d-dev libopencv-calib3d-dev libjs-three libjs-chart.js)
ros=(libroscpp-dev libnav-msgs-dev libsensor-msgs-dev libstd-srvs-dev libtf2-msgs-dev
     libvisualization-msgs-dev python3-roslaunch rosout python3-rospy python3-nav-msgs
     python3-std-srvs python3-tf2-msgs python3-visualization-msgs)
python=(python3-dev python3-venv)
test=(libgtest-dev libgmock-dev python3 file pkgconf clang-14 clang-format-14
      libembree-dev chromium mkdocs-material python3-dev python3-venv python3-numpy python3-pytest
      pybind11-dev python3-distributed python3-fsspec "${ros[@]}")
dev=(clang-tidy-14 doxygen libbenchmark-dev python3-shapely mypy git)
fuzz=(clang-14 libclang-rt-14-dev)
any_clang=(clang libclang-rt-dev)

what=${1:-test}
case "$what" in
  build) wanted=("${build[@]}") ;;
  python) wanted=("${build[@]}" "${python[@]}") ;;
  vision) wanted=("${build[@]}" python3) ;;
  test) wanted=("${build[@]}" "${test[@]}") ;;
  dev) wanted=("${build[@]}" "${test[@]}" "${dev[@]}") ;;
  fuzz)
    apt-cache show "${fuzz[@]}" >/dev/null 2>&1 || fuzz=("${any_clang[@]}")
    wanted=("${build[@]}" "${fuzz[@]}")
    ;;
  *) echo "usage: scripts/install_deps.sh [build|python|vision|test|dev|fuzz]" >&2; exit 2 ;;
esac

# Not in the archive of every release, e.g. clang 14 in Debian 13; what needs them is skipped there.
optional=(clang-14 clang-format-14 clang-tidy-14 chromium mkdocs-material python3-distributed
          python3-fsspec "${ros[@]}")
in_this_release() {
  [[ " ${optional[*]} " != *" $1 "* ]] || apt-cache show "$1" >/dev/null 2>&1
}

missing=()
needed=0
for package in "${wanted[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] && continue
  missing+=("$package")
  if in_this_release "$package"; then needed=1; fi
done
models=0
if [[ $what != build && $what != python && $what != fuzz ]] && ! "$(dirname "$0")/install_onnxruntime.sh" --is-there; then models=1; fi
if ((!needed && !models)); then
  echo "dependencies: all there"
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "not root and no sudo; as root: scripts/install_deps.sh $what" >&2
    exit "$needed"  # ONNX Runtime alone can be done without
  fi
  as_root=(sudo)
fi

if ((needed)); then
  echo "dependencies: installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  available=()
  for package in "${missing[@]}"; do
    if in_this_release "$package"; then
      available+=("$package")
    else
      echo "dependencies: this release has no $package; the check that needs it will be skipped"
    fi
  done
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends -o Dpkg::Use-Pty=0 "${available[@]}" >/dev/null
fi

if ((models)) && ! "${as_root[@]}" "$(dirname "$0")/install_onnxruntime.sh"; then
  echo "dependencies: ONNX Runtime could not be installed: models cannot be run, all else works" \
    "(docs/models.md)"
fi
