# Which commit is this? Written to common/report/commit.h at build time, so that every figure can name it.
add_custom_target(palpate_commit
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION} -DOUT=${PROJECT_BINARY_DIR}/generated/palpate_commit.h
          -P ${PROJECT_SOURCE_DIR}/cmake/write_commit.cmake
  BYPRODUCTS ${PROJECT_BINARY_DIR}/generated/palpate_commit.h
  VERBATIM)
