# The only file that knows the compiler. Every target of ours links palpate::options.
add_library(palpate_options INTERFACE)
add_library(palpate::options ALIAS palpate_options)

target_compile_features(palpate_options INTERFACE cxx_std_20)
target_include_directories(palpate_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(palpate_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Wimplicit-fallthrough -Wdouble-promotion
  $<$<COMPILE_LANGUAGE:CXX>:-Wold-style-cast>
  -ffp-contract=off)  # the same bits from every optimisation level; see docs/architecture.md
if(PALPATE_ROOMS AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # gcc looks for what it may forget whenever it holds 128 MB, a tenth of its time; the files of a room hold several times that.
  target_compile_options(palpate_options INTERFACE --param=ggc-min-heapsize=786432)
endif()
if(PALPATE_WERROR)
  target_compile_options(palpate_options INTERFACE -Werror)
endif()
if(PALPATE_SANITIZE)
  # A finding ends the program, whatever the environment says.
  target_compile_options(palpate_options INTERFACE -fsanitize=${PALPATE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(palpate_options INTERFACE -fsanitize=${PALPATE_SANITIZE})
endif()
