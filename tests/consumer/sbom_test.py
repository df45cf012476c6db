#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The bill of materials: valid, and complete for the sources, the packages and the binaries.
usage: sbom_test.py SBOM SOURCE_FOLDER BINARY..."""
import json
import os
import re
import shutil
import subprocess
import sys

# Names of shared libraries -> package; '' comes with the compiler or is ours.
LIBRARIES = {'lib(sslcd|stdc|m|gcc_s|c|pthread|dl|rt|gomp)|ld-': '', 'libopencv_(\\w+)': r'OpenCV \1', 'libyaml-cpp': 'yaml-cpp',
             'libglog': 'glog', 'lib(cholmod|cxsparse|spqr|(c|ccol|col)?amd|camd|suitesparse)': 'SuiteSparse',
             'lib(lapack|blas|f77blas|cblas|atlas|openblas)': 'LAPACK and BLAS', 'liblz4': 'LZ4', 'libpugixml': 'pugixml',
             'libsqlite3': 'SQLite', 'libspdlog': 'spdlog', 'libfmt': 'fmt', 'libembree\\d?': 'Embree', 'libceres': 'Ceres Solver'}
NOT_LINKED = {'build-essential', 'cmake', 'ninja-build', 'ccache'}


def package_of(library):
    for pattern, package in LIBRARIES.items():
        found = re.match(rf'(?:{pattern})(?=[.+-]|$)', library)
        if found or pattern.endswith('ld-') and library.startswith('ld-'):
            return found.expand(package) if found else ''
    return library + ', of which this test knows no package'


def main():
    path, source, binaries = sys.argv[1], sys.argv[2], sys.argv[3:]
    with open(path) as file:
        sbom = json.load(file)
    assert (sbom['spdxVersion'], sbom['dataLicense'], sbom['SPDXID']) == ('SPDX-2.3', 'CC0-1.0', 'SPDXRef-DOCUMENT')
    assert re.fullmatch(r'\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ', sbom['creationInfo']['created'])
    packages = {package['SPDXID']: package for package in sbom['packages']}
    assert len(packages) == len(sbom['packages']), 'ids are not unique'
    for id, package in packages.items():
        assert re.fullmatch(r'SPDXRef-[A-Za-z0-9.-]+', id), id
        assert package['licenseDeclared'] and package['downloadLocation'], id
        version = package.get('versionInfo')
        assert version is None or re.fullmatch(r'[0-9]+(\.[0-9]+)*', version), (id, version)
    unversioned = {package['name'] for package in packages.values() if 'versionInfo' not in package}
    assert unversioned <= {'LAPACK and BLAS', 'ONNX Runtime', 'Embree'}, unversioned
    related = {end for relation in sbom['relationships'] for end in (relation['spdxElementId'], relation['relatedSpdxElement'])}
    assert related == set(packages) | {'SPDXRef-DOCUMENT'}, related ^ set(packages)

    text = json.dumps(sbom)
    names = {package['name'] for package in packages.values()}
    contained = {packages[relation['relatedSpdxElement']]['name'] for relation in sbom['relationships'] if relation['relationshipType'] == 'CONTAINS'}
    for folder in os.listdir(source + '/third_party'):
        assert any(folder in name.lower().replace(' ', '') for name in contained), f'third_party/{folder} is not named'
    with open(source + '/scripts/install_deps.sh') as file:
        listed = set(re.search(r'^build=\((.*?)\)', file.read(), re.M | re.S)[1].split()) - NOT_LINKED
    if 'three.js' not in names:  # a build without reports
        listed = {package for package in listed if not package.startswith('libjs-')}
    missing = {package for package in listed if f'pkg:deb/debian/{package}"' not in text}
    assert not missing, f'not named: {missing}'
    if shutil.which('readelf'):
        for binary in binaries:
            needed = re.findall(r'\(NEEDED\).*\[(.*)\]', subprocess.run(['readelf', '-d', binary], capture_output=True, text=True, check=True).stdout)
            assert needed, binary
            unknown = {library for library in needed if package_of(library) and package_of(library) not in names}
            assert not unknown, f'{binary} links {unknown}, which is not named'
    print(f'{len(packages)} packages')


if __name__ == '__main__':
    main()
