# SPDX-License-Identifier: BSD-3-Clause
# Writes a bill of materials (SPDX 2.3, JSON) of what the libraries and tools are made of, and installs
# it as share/doc/sslcd/sbom.spdx.json: what is part of them, and what they link or load, with
# versions of this build and licences. The test consumer.sbom compares it with the binaries.
# Another library needs a row here. The same sources at the same commit give the same bytes.
function(sslcd_header_version output header macro)  # "1.9.2" of `#define MACRO "1.9.2"`
  set(version "")
  if(header AND EXISTS ${header})
    file(STRINGS ${header} line REGEX "define +${macro} " LIMIT_COUNT 1)
    string(REGEX REPLACE ".*${macro} +\"?([0-9.]+).*" "\\1" version "${line}")
  endif()
  set(${output} "${version}" PARENT_SCOPE)
endfunction()

function(sslcd_file_version output file regex)  # the first group of `regex`
  file(READ ${file} text)
  string(REGEX MATCH "${regex}" found "${text}")
  set(${output} "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

sslcd_header_version(flann ${FLANN_INCLUDE_DIR}/flann/config.h FLANN_VERSION_)
find_path(SSLCD_LZ4_INCLUDE_DIR lz4.h)
mark_as_advanced(SSLCD_LZ4_INCLUDE_DIR)
foreach(part MAJOR MINOR RELEASE)
  sslcd_header_version(lz4_${part} ${SSLCD_LZ4_INCLUDE_DIR}/lz4.h LZ4_VERSION_${part})
endforeach()
# name|version|licence|relation to sslcd|home|package of Debian
set(rows
  "lie|${PROJECT_VERSION}|BSD-3-Clause|CONTAINS|third_party/lie|"
  "Eigen|${Eigen3_VERSION}|MPL-2.0|STATIC_LINK|https://eigen.tuxfamily.org|libeigen3-dev"
  "Ceres Solver|${Ceres_VERSION}|BSD-3-Clause|STATIC_LINK|http://ceres-solver.org|libceres-dev"
  "SuiteSparse|${SuiteSparse_VERSION}|LGPL-2.1-or-later AND GPL-2.0-or-later|DYNAMIC_LINK|https://people.engr.tamu.edu/davis/suitesparse.html|libsuitesparse-dev"
  "LAPACK and BLAS||BSD-3-Clause|DYNAMIC_LINK|https://www.netlib.org/lapack|liblapack-dev"
  "glog|${glog_VERSION}|BSD-3-Clause|DYNAMIC_LINK|https://github.com/google/glog|libgoogle-glog-dev"
  "FLANN|${flann}|BSD-2-Clause|STATIC_LINK|https://github.com/flann-lib/flann|libflann-dev"
  "LZ4|${lz4_MAJOR}.${lz4_MINOR}.${lz4_RELEASE}|BSD-2-Clause|DYNAMIC_LINK|https://lz4.org|liblz4-dev"
  "yaml-cpp|${yaml-cpp_VERSION}|MIT|DYNAMIC_LINK|https://github.com/jbeder/yaml-cpp|libyaml-cpp-dev"
  "pugixml|${pugixml_VERSION}|MIT|DYNAMIC_LINK|https://pugixml.org|libpugixml-dev"
  "JSON for Modern C++|${nlohmann_json_VERSION}|MIT|STATIC_LINK|https://json.nlohmann.me|nlohmann-json3-dev")
if(TARGET sslcd_store_lib)
  list(APPEND rows "SQLite|${SQLite3_VERSION}|blessing|DYNAMIC_LINK|https://sqlite.org|libsqlite3-dev")
endif()
if(TARGET sslcd_vision)
  get_target_property(opencv opencv_core INTERFACE_INCLUDE_DIRECTORIES)
  list(GET opencv 0 opencv)
  foreach(part MAJOR MINOR REVISION)
    sslcd_header_version(opencv_${part} ${opencv}/opencv2/core/version.hpp CV_VERSION_${part})
  endforeach()
  set(modules core imgproc video calib3d)
  if(TARGET sslcd_run)
    list(APPEND modules imgcodecs features2d)
  endif()
  foreach(module ${modules})
    list(APPEND rows "OpenCV ${module}|${opencv_MAJOR}.${opencv_MINOR}.${opencv_REVISION}|Apache-2.0|DYNAMIC_LINK|https://opencv.org|libopencv-${module}-dev")
  endforeach()
  sslcd_file_version(onnx third_party/onnxruntime/README.md "ONNX Runtime ([0-9.]+)")
  list(APPEND rows
    "ONNX Runtime C header|${onnx}|MIT|CONTAINS|third_party/onnxruntime|"
    "ONNX Runtime||MIT|OPTIONAL_DEPENDENCY_OF|https://onnxruntime.ai|")
endif()
if(TARGET sslcd_run)
  foreach(package CLI11 spdlog fmt)
    find_package(${package} QUIET)
  endforeach()
  list(APPEND rows "CLI11|${CLI11_VERSION}|BSD-3-Clause|STATIC_LINK|https://github.com/CLIUtils/CLI11|libcli11-dev"
    "spdlog|${spdlog_VERSION}|MIT|DYNAMIC_LINK|https://github.com/gabime/spdlog|libspdlog-dev"
    "fmt|${fmt_VERSION}|MIT|DYNAMIC_LINK|https://fmt.dev|libfmt-dev")
  if(TARGET sslcd_embree)
    list(APPEND rows "Embree||Apache-2.0|DYNAMIC_LINK|https://www.embree.org|libembree-dev")
  endif()
  if(SSLCD_THREE_JS AND SSLCD_ORBIT_JS AND SSLCD_CHART_JS)
    sslcd_file_version(three ${SSLCD_THREE_JS} "REVISION=\"?([0-9]+)")
    sslcd_file_version(chart ${SSLCD_CHART_JS} "Chart.js v([0-9.]+)")
    list(APPEND rows "three.js|${three}|MIT|CONTAINS|https://threejs.org|libjs-three"
      "Chart.js|${chart}|MIT|CONTAINS|https://www.chartjs.org|libjs-chart.js")
  endif()
endif()

set(packages "")
set(relations "    {\"spdxElementId\": \"SPDXRef-DOCUMENT\", \"relationshipType\": \"DESCRIBES\", \"relatedSpdxElement\": \"SPDXRef-sslcd\"}")
function(sslcd_sbom_package name version licence home debian)
  string(MAKE_C_IDENTIFIER "${name}" id)
  string(REPLACE "_" "-" id "${id}")
  if(NOT home MATCHES "^http")
    set(home NOASSERTION)
  endif()
  set(text "    {\"SPDXID\": \"SPDXRef-${id}\", \"name\": \"${name}\", ")
  if(version)
    string(APPEND text "\"versionInfo\": \"${version}\", ")
  endif()
  if(debian)
    string(APPEND text "\"externalRefs\": [{\"referenceCategory\": \"PACKAGE-MANAGER\", \"referenceType\": \"purl\", \"referenceLocator\": \"pkg:deb/debian/${debian}\"}], ")
  endif()
  string(APPEND text "\"downloadLocation\": \"${home}\", \"filesAnalyzed\": false, \"licenseDeclared\": \"${licence}\", \"licenseConcluded\": \"NOASSERTION\", \"copyrightText\": \"NOASSERTION\"}")
  set(package "${text}" PARENT_SCOPE)
  set(id "SPDXRef-${id}" PARENT_SCOPE)
endfunction()
sslcd_sbom_package(sslcd ${PROJECT_VERSION} BSD-3-Clause "" "")
set(packages "${package}")
foreach(row IN LISTS rows)
  string(REPLACE "|" ";" row "${row}")
  list(GET row 0 name)
  list(GET row 1 version)
  list(GET row 2 licence)
  list(GET row 3 relation)
  list(GET row 4 home)
  list(GET row 5 debian)
  sslcd_sbom_package("${name}" "${version}" "${licence}" "${home}" "${debian}")
  string(APPEND packages ",\n${package}")
  set(ends "SPDXRef-sslcd;${id}")
  if(relation MATCHES "_OF$")
    list(REVERSE ends)
  endif()
  list(GET ends 0 from)
  list(GET ends 1 to)
  string(APPEND relations ",\n    {\"spdxElementId\": \"${from}\", \"relationshipType\": \"${relation}\", \"relatedSpdxElement\": \"${to}\"}")
endforeach()

# The time of the commit, or of SOURCE_DATE_EPOCH.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} log -1 --format=%ct OUTPUT_VARIABLE epoch
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(epoch)
    set(ENV{SOURCE_DATE_EPOCH} ${epoch})
    set(epoch_is_ours ON)
  endif()
endif()
string(TIMESTAMP created "%Y-%m-%dT%H:%M:%SZ" UTC)
if(epoch_is_ours)
  unset(ENV{SOURCE_DATE_EPOCH})
endif()
string(SHA256 content "${packages}${relations}")
set(SSLCD_SBOM ${PROJECT_BINARY_DIR}/sbom.spdx.json)
file(CONFIGURE OUTPUT ${SSLCD_SBOM} @ONLY CONTENT [=[{
  "spdxVersion": "SPDX-2.3",
  "dataLicense": "CC0-1.0",
  "SPDXID": "SPDXRef-DOCUMENT",
  "name": "sslcd-@PROJECT_VERSION@",
  "documentNamespace": "https://sslcd.invalid/spdx/@PROJECT_VERSION@-@content@",
  "creationInfo": {"created": "@created@", "creators": ["Tool: sslcd-cmake-@PROJECT_VERSION@"]},
  "packages": [
@packages@
  ],
  "relationships": [
@relations@
  ]
}
]=])
install(FILES ${SSLCD_SBOM} DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT dev)
