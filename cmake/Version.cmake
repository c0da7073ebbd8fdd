# cmake -DSOURCE=<root> -DHEADER=<file> -P Version.cmake: writes the commit of the checkout into a header, only if it has
# changed: only a new commit triggers the compilation of one small source.
set(commit "unknown")
# A source tree unpacked inside another project's checkout must not use that project's commit.
if(EXISTS ${SOURCE}/.git)
  find_program(GIT git)
  if(GIT)
    # No optional locks: a build must not block a concurrent commit.
    execute_process(COMMAND ${GIT} --no-optional-locks -C ${SOURCE} describe --always --abbrev=7 --exclude=* --dirty=+
      OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
    if(NOT failed AND found MATCHES "^[0-9a-f]+\\+?$")
      set(commit ${found})
    endif()
  endif()
endif()
set(text "#define SUTURE_COMMIT \"${commit}\"\n")
set(before "")
if(EXISTS ${HEADER})
  file(READ ${HEADER} before)
endif()
if(NOT text STREQUAL before)
  file(WRITE ${HEADER} "${text}")
endif()
