#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs ONNX Runtime, library and headers, as root; scripts/install_deps.sh calls it. Installs
# the package libonnxruntime-dev if the release has it (Debian 13). On Debian 12 installs the
# library of the Python wheel to /usr/local/lib and the headers of Debian 13's package to
# /usr/local/include/onnxruntime.
#   scripts/install_onnxruntime.sh [--is-there]
set -euo pipefail
version=1.21.1
package=libonnxruntime-dev

if [[ ${1:-} == --is-there ]]; then
  [[ -e /usr/include/onnxruntime/onnxruntime_c_api.h || -e /usr/local/include/onnxruntime/onnxruntime_c_api.h ]] &&
    [[ $(/sbin/ldconfig -p) == *libonnxruntime.so* ]]
  exit
fi

echo "dependencies: installing ONNX Runtime"
install_packages() {
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends -o Dpkg::Use-Pty=0 "$@" >/dev/null
}
apt-get update -qq
if apt-cache show "$package" >/dev/null 2>&1; then
  install_packages "$package"
  exit
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# Headers, from the Debian mirror that apt is set up for, without a trace in apt's own lists.
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | sed -n 1p)
[[ -n $mirror ]] || { echo "no Debian mirror in apt's sources to take the headers from" >&2; exit 1; }
keyring=/usr/share/keyrings/debian-archive-keyring.gpg
echo "deb [signed-by=$keyring] $mirror trixie main" >sources.list
mkdir -p lists/partial cache/archives/partial
apt=(apt-get -qq -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null
     -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work/cache" -o Dir::State::Status=/dev/null
     -o Acquire::Languages=none -o APT::Sandbox::User=root)
"${apt[@]}" update
"${apt[@]}" download "$package"
dpkg -x "$package"_*.deb headers

# The library: any wheel of the version has the same one.
python3 -m pip --version >/dev/null 2>&1 || install_packages python3-pip
python3 -m pip download -q --retries 1 --no-deps --only-binary=:all: --implementation cp --python-version 3.11 --abi cp311 \
  --platform "manylinux_2_27_$(uname -m)" --platform "manylinux_2_28_$(uname -m)" "onnxruntime==$version"
python3 - "$version" <<'PY'
import glob, sys, zipfile
name = "libonnxruntime.so." + sys.argv[1]
with zipfile.ZipFile(glob.glob("onnxruntime-*.whl")[0]) as wheel, open(name, "wb") as library:
    library.write(wheel.read("onnxruntime/capi/" + name))
PY

install -d /usr/local/lib /usr/local/include/onnxruntime
install -m 755 "libonnxruntime.so.$version" /usr/local/lib/
ln -sf "libonnxruntime.so.$version" /usr/local/lib/libonnxruntime.so.1
ln -sf libonnxruntime.so.1 /usr/local/lib/libonnxruntime.so
cp -r headers/usr/include/onnxruntime/. /usr/local/include/onnxruntime/
/sbin/ldconfig
