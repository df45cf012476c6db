# SPDX-License-Identifier: BSD-3-Clause
# Run by cpack before it packs (CPACK_PRE_BUILD_SCRIPTS). With SOURCE_DATE_EPOCH in the environment,
# files get this time, so that the same files make the same package.
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND find ${CPACK_TEMPORARY_DIRECTORY} -exec
    touch --no-dereference --date=@$ENV{SOURCE_DATE_EPOCH} {} + COMMAND_ERROR_IS_FATAL ANY)
endif()
