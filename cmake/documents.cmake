# The guide, the scenes and the examples of plugins. Scenes and examples lie in share/suture as in the checkout, documents in share/doc/suture, and
# share/suture/doc links to them: with SUTURE=<prefix>/share/suture every command of the guide runs.
# Links are adapted at installation: AdaptLinks.cmake.
set(SUTURE_SHARE ${CMAKE_INSTALL_DATADIR}/suture)
set(documents ${CMAKE_BINARY_DIR}/documents)
install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" \"-DSOURCE=${CMAKE_SOURCE_DIR}\" \"-DOUTPUT=${documents}\"
  \"-DDOC=${CMAKE_INSTALL_DOCDIR}\" \"-DSHARE=${SUTURE_SHARE}\" -P \"${CMAKE_SOURCE_DIR}/cmake/AdaptLinks.cmake\" COMMAND_ERROR_IS_FATAL ANY)"
  COMPONENT runtime)
install(DIRECTORY ${documents}/doc/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(DIRECTORY ${documents}/share/ DESTINATION ${SUTURE_SHARE} COMPONENT runtime)
file(RELATIVE_PATH link /${SUTURE_SHARE} /${CMAKE_INSTALL_DOCDIR}/doc)
file(CREATE_LINK ${link} ${CMAKE_BINARY_DIR}/doc_link SYMBOLIC)
install(FILES ${CMAKE_BINARY_DIR}/doc_link DESTINATION ${SUTURE_SHARE} RENAME doc COMPONENT runtime)
