# SPDX-License-Identifier: BSD-3-Clause
# Embree 3 or 4 as the target sslcd_embree, if it is installed. Searches header and library, because
# Embree's package file requires a TBB that a host may lack, and its versions have different target
# names.
find_path(SSLCD_EMBREE_INCLUDE_DIR NAMES embree4/rtcore.h embree3/rtcore.h)
find_library(SSLCD_EMBREE_LIBRARY NAMES embree4 embree3)
mark_as_advanced(SSLCD_EMBREE_INCLUDE_DIR SSLCD_EMBREE_LIBRARY)
if(SSLCD_EMBREE_INCLUDE_DIR AND SSLCD_EMBREE_LIBRARY)
  add_library(sslcd_embree UNKNOWN IMPORTED GLOBAL)
  set_target_properties(sslcd_embree PROPERTIES
    IMPORTED_LOCATION ${SSLCD_EMBREE_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${SSLCD_EMBREE_INCLUDE_DIR})
else()
  message(STATUS
    "Embree not found: no sslcd_sim --render (scripts/install_deps.sh test installs it)")
endif()
