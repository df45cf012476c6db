#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the library ONNX Runtime, which runs models; scripts/install_deps.sh calls it. sslcd
# loads it when it needs it: nothing has to be built again.
#   scripts/install_onnxruntime.sh               as root: the release's package (Debian 13), or the
#                                                library of the Python wheel in /usr/local/lib
#                                                (Debian 12, Ubuntu 24.04)
#   scripts/install_onnxruntime.sh --to FOLDER   the wheel's library in FOLDER, without root
#   scripts/install_onnxruntime.sh --is-there    exit code 0 if it is installed
set -euo pipefail
version=1.21.1
package=libonnxruntime-dev  # has the name libonnxruntime.so, which is looked for

folder=/usr/local/lib
case "${1:-}" in
  --is-there) [[ $(/sbin/ldconfig -p) =~ libonnxruntime\.so(\.1)?\  ]]; exit ;;
  --to) folder=$(realpath -m -- "${2:?usage: scripts/install_onnxruntime.sh --to FOLDER}") ;;
  "") ;;
  *) sed -n 3,10p "$0" >&2; exit 2 ;;
esac

install_packages() {
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends -o Dpkg::Use-Pty=0 "$@" >/dev/null
}
if [[ -z ${1:-} ]]; then
  echo "dependencies: installing ONNX Runtime"
  apt-get update -qq
  if apt-cache show "$package" >/dev/null 2>&1; then
    install_packages "$package"
    exit
  fi
  python3 -m pip --version >/dev/null 2>&1 || install_packages python3-pip
fi

# Any wheel of the version has the same library.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m pip download -q --retries 1 --no-deps --only-binary=:all: --implementation cp --python-version 3.11 --abi cp311 \
  --platform "manylinux_2_27_$(uname -m)" --platform "manylinux_2_28_$(uname -m)" --dest "$work" "onnxruntime==$version"
python3 - "$work" "$version" <<'PY'
import glob, sys, zipfile
folder, name = sys.argv[1], "libonnxruntime.so." + sys.argv[2]
with zipfile.ZipFile(glob.glob(folder + "/onnxruntime-*.whl")[0]) as wheel, open(folder + "/" + name, "wb") as library:
    library.write(wheel.read("onnxruntime/capi/" + name))
PY
install -d "$folder"
install -m 755 "$work/libonnxruntime.so.$version" "$folder/"
ln -sf "libonnxruntime.so.$version" "$folder/libonnxruntime.so.1"
ln -sf libonnxruntime.so.1 "$folder/libonnxruntime.so"
if [[ -z ${1:-} ]]; then
  /sbin/ldconfig
else
  echo "ONNX Runtime is in $folder; sslcd finds it with: export SSLCD_ORT_LIB=$folder/libonnxruntime.so.1"
fi
